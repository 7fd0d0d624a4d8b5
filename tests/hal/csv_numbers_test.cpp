#include <catch2/catch.hpp>

#include "hal/formats/csv_cells.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/hal/foreign_file_builder.hpp"

// How the tables of other programs write their numbers and names.
namespace rvbench::hal {
namespace {

using Catch::Contains;
using formats::csv_cells;
using formats::csv_separator;

Recording read_csv(const std::string& bytes) { return test::recordings_in("a.csv", bytes)[0]; }

std::string complaint(const std::string& bytes) { return test::complaint_of("a.csv", bytes); }

}  // namespace

TEST_CASE("a decimal comma is read where columns are parted by another mark", "[hal][formats]") {
  for (const char* text : {"a;b\n1,5;-2,25e1\n0,5;3\n", "a\tb\n1,5\t-2,25e1\n0,5\t3\n",
                           "a,b\n\"1,5\",\"-2,25e1\"\n\"0,5\",3\n"}) {
    const Recording recording = read_csv(text);
    REQUIRE(recording.channels.size() == 2);
    CHECK(recording.channels[0].samples == Eigen::Vector2d(1.5, 0.5));
    CHECK(recording.channels[1].samples == Eigen::Vector2d(-22.5, 3));
    REQUIRE(recording.notes.size() == 1);
    CHECK(recording.notes[0] == "numbers have a decimal comma");
  }
  const Recording headless = read_csv("0,5;1,5\n2,5;3,5\n");
  CHECK(headless.channels.at(1).samples == Eigen::Vector2d(1.5, 3.5));
  CHECK(read_csv("a;b\n1.5;2\n").notes.empty());
}

TEST_CASE("numbers that contradict each other are rejected, with both places", "[hal][formats]") {
  CHECK_THAT(complaint("a;b\n1,5;2\n1;2.5\n"),
             Contains("\"2.5\" (3:2) has a decimal point, \"1,5\" (2:1) a decimal comma"));
  CHECK_THAT(complaint("a;b\n1.5;2\n1;2,5\n"),
             Contains("\"1.5\" (2:1) has a decimal point, \"2,5\" (3:2) a decimal comma"));
  CHECK_THAT(complaint("a,b\n1,5,2,5\n"),
             Contains("2: 4 values, not 2") &&
                 Contains("with decimal commas, columns are to be parted by ;"));
  CHECK_THAT(complaint("a,b\n1,2,3\n"), Contains("2: 3 values, not 2") && !Contains("decimal"));
}

TEST_CASE("a mark before three digits in all cells that have one parts thousands",
          "[hal][formats]") {
  const auto [text, first, second] = GENERATE(table<std::string, double, double>({
      {"a,b\n\"1,218\",2\n\"644\",2\n", 1218, 644},
      {"a,b\n\"-1,234,567\",2\n\"999\",2\n", -1234567, 999},
      {"a,b\n\"1,218.5\",2\n0.25,2\n", 1218.5, 0.25},
      {"a;b\n1.218,5;2\n0,25;2\n", 1218.5, 0.25},
      {"a;b\n1,234,567;2\n89;2\n", 1234567, 89},
  }));
  CAPTURE(text);
  CHECK(read_csv(text).channels.at(0).samples == Eigen::Vector2d(first, second));
}

TEST_CASE("a comma that may part thousands or decimals is rejected with both readings",
          "[hal][formats]") {
  CHECK_THAT(complaint("a,b\n\"1,218\",2\n\"0,8\",2\n"),
             Contains("thousands in \"1,218\" (2:1) and decimals in \"0,8\" (3:1)") &&
                 Contains("--decimal"));
  CHECK_THAT(complaint("a;b\n1,218;2\n644;2\n"),
             Contains("\"1,218\" (2:1) may be a thousand or more, or a decimal number") &&
                 Contains("\"644\" (3:1)"));
  // Fixed decimals: each cell of the column has its comma.
  CHECK(read_csv("a;b\n1,218;2\n2,644;2\n").channels[0].samples == Eigen::Vector2d(1.218, 2.644));
}

TEST_CASE("whole numbers without names that may be halves of others are told, or refused",
          "[hal][formats]") {
  const std::string note = "taken as two columns of whole numbers, not as one with a decimal comma";
  CHECK(read_csv("0,123\n0,456\n").notes == std::vector<std::string>{note});
  CHECK_THAT(complaint("0,123\n0,050\n"), Contains("a.csv: 2:2: begins with 0: if numbers have"));
  CHECK(read_csv("a,b\n0,123\n0,050\n").notes.empty());
  CHECK(read_csv("0.5,123\n0.25,050\n").notes.empty());
  CHECK(read_csv("1,2,3\n4,5,6\n").notes.empty());
  CHECK(read_csv("\"0,123\"\n\"0,050\"\n").channels.at(0).samples == Eigen::Vector2d(0.123, 0.05));
}

TEST_CASE("names and numbers in quotes are those within", "[hal][formats]") {
  const Recording recording = read_csv("\"a, left\" , \"b \"\n\"1\",2\n 3 , \"4\" \n");
  REQUIRE(recording.channels.size() == 2);
  CHECK(recording.channels[0].info.name == "a, left");
  CHECK(recording.channels[1].info.name == "b");
  CHECK(recording.channels[0].samples == Eigen::Vector2d(1, 3));
  CHECK(recording.channels[1].samples == Eigen::Vector2d(2, 4));
  CHECK(csv_cells("\"a \"\"x\"\"\",b", ',')->size() == 2);
  CHECK_THAT(complaint("\"a,b\n1,2\n"), Contains("a.csv: 1: a quote that does not end"));
  CHECK_THAT(complaint("a,b\n1,\"2\n"), Contains("2: a quote that does not end"));
}

TEST_CASE("what parts columns is not looked for within quotes", "[hal][formats]") {
  CHECK(csv_separator("a,b") == ',');
  CHECK(csv_separator("a;b, left") == ';');
  CHECK(csv_separator("a\tb; left") == '\t');
  CHECK(csv_separator("\"a;left\",b") == ',');
  CHECK_FALSE(csv_separator("\"a,b\""));
  CHECK_FALSE(csv_separator("a"));
}

TEST_CASE("a blank line among samples is a sample lost, and one behind them is none",
          "[hal][formats]") {
  CHECK_THAT(complaint("a\n1\n2\n\n4\n"), Contains("4: a blank line, and samples behind it"));
  CHECK_THAT(complaint("1\n \r\n3\n"), Contains("2: a blank line"));
  CHECK_THAT(complaint("a,b\n1,2\n\n\n3,4\n"), Contains("3: a blank line"));
  CHECK(read_csv("a\n\n1\n2\n").channels[0].samples == Eigen::Vector2d(1, 2));
  CHECK(read_csv("a\r\n1\r\n2\r\n\r\n \n").channels[0].samples == Eigen::Vector2d(1, 2));
}

}  // namespace rvbench::hal
