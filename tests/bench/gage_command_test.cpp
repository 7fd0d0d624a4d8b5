#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/gage_studies.hpp"
#include "tests/support/scratch_folder.hpp"

// `gage`: a table of readings in, what the gage is worth out.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::aiag_study;
using rvbench::test::ScratchFolder;
using rvbench::test::simulated_study;
using test::CommandAnswer;
using test::rvbench;

const std::string head = "part,operator,trial,value [mm]\n";

std::string rows_of(const analysis::GageReadings& study) {
  std::string rows;
  for (std::size_t part = 0; part < study.parts; ++part) {
    for (std::size_t op = 0; op < study.operators; ++op) {
      for (std::size_t trial = 0; trial < study.trials; ++trial) {
        rows += fmt::format("{},{},{},{:.6g}\n", part + 1, char('A' + op), trial + 1,
                            study.at(part, op, trial));
      }
    }
  }
  return rows;
}

std::string file_of(const ScratchFolder& scratch, const std::string& text) {
  const auto file = scratch / "study.csv";
  write_file(file, text);
  return file.string();
}

std::string gage_refusal(const std::string& text) {
  const ScratchFolder scratch;
  const CommandAnswer answer = rvbench({"gage", file_of(scratch, text)});
  CHECK(answer.code == 20);
  CHECK(answer.out.empty());
  return answer.err;
}

}  // namespace

TEST_CASE("gage tells the manual's example as the manual does", "[bench][station][literature]") {
  const ScratchFolder scratch;
  const std::string file = file_of(scratch, head + rows_of(aiag_study()));
  const CommandAnswer answer = rvbench({"gage", file});
  CHECK(answer.code == 0);
  CHECK(answer.err.empty());
  CHECK_THAT(answer.out, Contains("MAY BE ACCEPTABLE  The gage makes up 27.9 % of the total") &&
                             Contains("tells 4 categories of parts apart") &&
                             Contains("10 parts x 3 operators x 3 trials, in mm") &&
                             Contains("pooled with repeatability (p = 0.974)") &&
                             Contains("EV repeatability      0.199933") && Contains("20.9 %") &&
                             !Contains("tolerance"));
  const auto json = nlohmann::json::parse(rvbench({"gage", file, "--json"}).out);
  CHECK(json.at("verdict") == "conditional");
  CHECK(json.at("unit") == "mm");
  CHECK(json.at("gage_share").get<double>() == Approx(0.2786).margin(1e-4));
  CHECK(json.at("distinct_categories") == 4);
  CHECK(json.at("components").at("gage").at("deviation").get<double>() ==
        Approx(0.30237).margin(5e-6));
  CHECK(json.at("anova").at("pooled") == true);
  CHECK(json.at("tolerance").is_null());
  CHECK(json.at("components").at("interaction").is_null());
}

TEST_CASE("an interaction that is there is told by itself", "[bench][station]") {
  const ScratchFolder scratch;
  const auto study = simulated_study({.parts = 1, .interaction = 0.5}, 10, 3, 3, 2);
  const std::string file = file_of(scratch, head + rows_of(study));
  CHECK_THAT(rvbench({"gage", file}).out,
             Contains("INT interaction") && Contains("parts is kept apart (p = "));
  const auto json = nlohmann::json::parse(rvbench({"gage", file, "--json"}).out);
  CHECK(json.at("components").at("interaction").at("deviation").get<double>() ==
        Approx(0.5).epsilon(0.4));
}

TEST_CASE("the word is that of the larger of both shares", "[bench][station]") {
  const ScratchFolder scratch;
  const auto word = [&](const analysis::GageReadings& study, std::vector<std::string> more) {
    more.insert(more.begin(), {"gage", file_of(scratch, head + rows_of(study)), "--json"});
    return nlohmann::json::parse(rvbench(more).out).at("verdict").get<std::string>();
  };
  const auto good = simulated_study({.parts = 1, .repeatability = 0.02}, 10, 3, 3, 1);
  CHECK(word(good, {}) == "acceptable");
  CHECK(word(good, {"--tolerance", "100"}) == "acceptable");
  CHECK(word(good, {"--tolerance", "0.6"}) == "conditional");
  CHECK(word(good, {"--tolerance", "0.1"}) == "not_acceptable");
  CHECK(word(simulated_study({.parts = 0.1, .repeatability = 1}, 10, 3, 3, 1), {}) ==
        "not_acceptable");
}

TEST_CASE("rows come in any order, and trials have any names", "[bench][station]") {
  const ScratchFolder scratch;
  const std::string rows =
      "y;Bo;second;2.1\nx;Al;first;1\n\ny;Al;first;2\nx;Bo;second;1.2\nx;Al;second;1.1\n"
      "y;Al;second;2.2\nx;Bo;first;1.1\ny;Bo;first;2.3\n";
  const CommandAnswer answer =
      rvbench({"gage", file_of(scratch, "part;operator;trial;value\n" + rows), "--json"});
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  const auto json = nlohmann::json::parse(answer.out);
  CHECK(json.at("unit").is_null());
  // Within cells: differences 0.1, 0.2, 0.1 and 0.2, so the sum of squares is 0.05.
  CHECK(json.at("anova").at("repeatability").at("sum_of_squares").get<double>() == Approx(0.05));
}

TEST_CASE("the folder of --out holds the page and the document", "[bench][station]") {
  const ScratchFolder scratch;
  const std::string file = file_of(scratch, head + rows_of(aiag_study()));
  const std::string out = (scratch / "gage").string();
  CHECK_THAT(rvbench({"gage", file, "--tolerance", "5", "--out", out}).out,
             Contains("of tolerance") && Contains("Report: " + out + "/gage.html"));
  const std::string page = read_file(scratch / "gage/gage.html").value();
  CHECK_THAT(page, Contains("<svg") && Contains("Operator C") && Contains("value [mm]") &&
                       Contains("36.3 %") && !Contains("nan") && !Contains("href=\"http"));
  CHECK(nlohmann::json::parse(read_file(scratch / "gage/gage.json").value()).at("tolerance") == 5);
  const CommandAnswer again = rvbench({"gage", file, "--out", out});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("holds a gage.json already"));
}

TEST_CASE("a study that is not whole is refused, with the place", "[bench][station]") {
  const std::string rows = rows_of(simulated_study({}, 3, 2, 2, 1));
  const std::string all_but_last = rows.substr(0, rows.rfind("3,B,2"));
  CHECK_THAT(gage_refusal(head + all_but_last),
             Contains("part 3, operator B, trial 2 is missing: every operator must read"));
  std::string stamped = head;  // as many parts, operators and trials as rows: 10^12 readings
  for (int i = 0; i < 10'000; ++i) stamped += fmt::format("p{0},o{0},t{0},1\n", i);
  CHECK_THAT(gage_refusal(stamped), Contains("part p0, operator o0, trial t1 is missing"));
  CHECK_THAT(gage_refusal(head + rows + "1,A,1,7\n"),
             Contains("study.csv:14: part 1, operator A, trial 1 is there twice, first in line 2"));
  CHECK_THAT(gage_refusal(head + "1,A,1,x7\n"), Contains("study.csv:2: value: \"x7\" is not a number"));
  CHECK_THAT(gage_refusal(head + "1,A,1,nan\n"), Contains("study.csv:2: value is lost"));
  CHECK_THAT(gage_refusal(head + "1,A,1\n"), Contains("study.csv:2: 3 values, not 4"));
  CHECK_THAT(gage_refusal(head + "1,A,1,2\n1,A,2,3\n"), Contains("1 part(s), 1 operator(s)"));
  CHECK_THAT(gage_refusal(head), Contains("no rows"));
  CHECK_THAT(gage_refusal("part,operator,value\n1,A,2\n"),
             Contains("no column \"trial\": the first line names the columns part, operator, "
                      "trial, value"));
  CHECK_THAT(gage_refusal("part,part,operator,trial,value\n"), Contains("\"part\" is there twice"));
  CHECK_THAT(gage_refusal(head + "1,A,1,2\n1,A,2,2\n1,B,1,2\n1,B,2,2\n"
                            "2,A,1,3\n2,A,2,3\n2,B,1,3\n2,B,2,3\n"),
             Contains("too coarse to tell the gage's error"));
}

TEST_CASE("readings whose squares overflow, or vanish, are no study", "[bench][station]") {
  const std::string power = GENERATE("e200", "e100", "e-100");
  CAPTURE(power);
  std::string rows;
  for (const char* row :
       {"x,A,1,1", "x,A,2,2", "x,B,1,3", "x,B,2,1", "y,A,1,5", "y,A,2,6", "y,B,1,6", "y,B,2,8"}) {
    rows += row + power + "\n";
  }
  CHECK_THAT(gage_refusal(head + rows), Contains("study.csv: cannot tell: the readings are too large"));
}

TEST_CASE("a tolerance by which a share overflows is refused", "[bench][station]") {
  const ScratchFolder scratch;
  const std::string file = file_of(scratch, head + rows_of(aiag_study()));
  const CommandAnswer answer = rvbench({"gage", file, "--tolerance", "1e-308"});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("--tolerance is too small"));
  CHECK(rvbench({"gage", file, "--tolerance", "1e-300"}).code == 0);
}

TEST_CASE("a file that is not there, and a tolerance of nothing, are refused", "[bench][station]") {
  CHECK(rvbench({"gage", "/nowhere.csv"}).code == 20);
  const CommandAnswer answer = rvbench({"gage", "/nowhere.csv", "--tolerance", "0"});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("--tolerance must be above 0"));
  const auto json = nlohmann::json::parse(rvbench({"gage", "/nowhere.csv", "--json"}).out);
  CHECK(json.at("exit_code") == 20);
  CHECK_THAT(rvbench({"gage", "--help"}).out, Contains("part,operator,trial,value [mm]"));
}

}  // namespace rvbench::bench
