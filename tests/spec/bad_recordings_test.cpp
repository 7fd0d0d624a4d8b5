#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "bench/text_file.hpp"
#include "tests/hal/mat5_builder.hpp"
#include "tests/hal/recording_fixture.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"

// A 2 GB claim must be refused by its header, not tried out.
namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::ScratchFolder;

struct BadRecording {
  const char* name;  // of the file
  std::string bytes;
  const char* told;  // after the file's name
};

Answer judge(const ScratchFolder& scratch, const std::string& file) {
  return test::rvbench(scratch.path(), {"judge", file, "--kinematics", "cwru_6205", "--rate",
                                        "1000", "--speed", "600", "--json"});
}

void check_refused(const BadRecording& bad) {
  DYNAMIC_SECTION(bad.name << ": " << bad.told) {
    const ScratchFolder scratch;
    std::ofstream(scratch.path() / bad.name, std::ios::binary) << bad.bytes;
    const Answer answer = judge(scratch, bad.name);
    INFO(answer.err);
    CHECK(answer.code == 20);
    const auto refusal = nlohmann::json::parse(answer.out);
    CHECK(refusal.at("verdict") == "INVALID");
    CHECK(refusal.at("exit_code") == 20);
    CHECK_THAT(answer.err, Contains(std::string(bad.name) + ": " + bad.told));
    CHECK_THAT(answer.err, !Contains("Sanitizer") && !Contains("runtime error"));
  }
}

// Two columns of noise, 2 s at 1 kHz, of which `change` may spoil any value.
std::string csv(const std::function<std::string(int row, int column, std::string value)>& change) {
  std::mt19937 random(7);
  std::string text = "a,b\n";
  for (int row = 0; row < 2000; ++row) {
    for (int column = 0; column < 2; ++column) {
      const double value = (static_cast<double>(random() % 2001) - 1000) / 1000;
      text += change(row, column, std::to_string(value)) + (column == 0 ? "," : "\n");
    }
  }
  return text;
}

// A variable whose header claims `bytes` of doubles and holds none.
std::string claim(std::uint32_t bytes) {
  using namespace test;
  return mat5_file({mat5_word(14) + mat5_word(bytes) +
                    mat5_element(6, mat5_word(6) + mat5_word(0)) +
                    mat5_element(5, mat5_word(bytes / 8) + mat5_word(1)) + mat5_element(1, "x") +
                    mat5_word(9) + mat5_word(bytes - 48)});
}

std::string wave_claim() {
  using test::mat5_word;
  return "RIFF" + mat5_word(0x7fffffff) + "WAVEfmt " + mat5_word(16) + std::string(16, '\1') +
         "data" + mat5_word(0x7fffffff);
}

std::string recording(const ScratchFolder& scratch) {
  const auto made =
      hal::RecordingWriter::create(scratch.path() / "whole.h5", test::layout_of(1, 2));
  REQUIRE(made);
  REQUIRE(made.value()->append(0, test::acceleration_block(0, 0, 600, 2)));
  REQUIRE(made.value()->end_point({0, 0, "ok", 605, 1}));
  REQUIRE(made.value()->close());
  return bench::read_file(scratch.path() / "whole.h5").value();
}

}  // namespace

TEST_CASE("a file that is no recording is refused by name and place", "[spec][bad_files]") {
  const std::string mat =
      test::mat5_file({test::mat5_array("x", 600, 1, std::vector<double>(600))});
  const std::vector<BadRecording> files{
      {"empty.h5", "", "is empty"},
      {"empty.mat", "", "is empty"},
      {"empty.csv", "", "is empty"},
      {"text.h5", "no recording at all\n", "not a recording: no HDF5 signature"},
      {"text.mat", "no recording at all\n", "shorter than the header of a MAT v5 file"},
      {"cut.mat", mat.substr(0, 2000), "variable at byte 128: claims"},
      {"header.mat", mat.substr(0, 128), "holds no samples"},
      {"claim.mat", claim(0x7ffffff0), "variable at byte 128: claims 2147483632 bytes"},
      {"claim.wav", wave_claim(), "encoding 257 of 257 bits, not PCM"},
      {"header.csv", "a,b\n", "holds no samples"},
      {"ragged.csv", "a,b\n1,2\n3\n", "3: 1 values, not 2"},
      {"cut.csv", "a,b\n1,2\n3,4e", "3:2: \"4e\" is not a number"},
      {"words.csv", "a,b\n1,2\nx,3\n", "3:1: \"x\" is not a number"},
      {"huge.csv", "a,b\n1,2\n1e999,3\n", "3:1: \"1e999\" is not a number"},
      {"twice.csv", "a,a\n1,2\n", "1:2: channel \"a\" is there twice"},
  };
  for (const BadRecording& bad : files) check_refused(bad);
}

TEST_CASE("a recording that was cut is refused", "[spec][bad_files]") {
  const ScratchFolder scratch;
  const std::string bytes = recording(scratch);
  for (const std::size_t length : {std::size_t(8), std::size_t(600), bytes.size() / 2}) {
    check_refused({"cut.h5", bytes.substr(0, length), ""});
  }
}

TEST_CASE("samples that say nothing are INVALID, never PASS", "[spec][bad_files]") {
  struct Case {
    const char* name;
    std::string text;
    const char* reason;
  };
  const std::vector<Case> cases{
      {"all zeros", csv([](int, int, std::string) { return "0"; }), "a: dead"},
      {"constant channel", csv([](int, int c, std::string v) { return c == 1 ? "3.5" : v; }),
       "b: dead"},
      {"a channel of NaN", csv([](int, int c, std::string v) { return c == 1 ? "nan" : v; }),
       "b: lost samples: 2000 of 2000"},
      {"one NaN", csv([](int r, int c, std::string v) { return r == 9 && c == 0 ? "nan" : v; }),
       "a: lost samples: 1 of 2000"},
      {"ten samples", "a,b\n1,2\n2,1\n1,2\n2,1\n1,2\n2,1\n1,2\n2,1\n1,2\n2,1\n",
       "a: too short: 10 samples"},
  };
  for (const Case& bad : cases) {
    DYNAMIC_SECTION(bad.name) {
      const ScratchFolder scratch;
      bench::write_file(scratch.path() / "r.csv", bad.text);
      const Answer answer = judge(scratch, "r.csv");
      CHECK(answer.code == 20);
      const auto json = nlohmann::json::parse(answer.out);
      CHECK(json.at("verdict") == "INVALID");
      CHECK_THAT(json.at("reason").get<std::string>(),
                 Contains(std::string("r.csv, ") + bad.reason));
    }
  }
}

}  // namespace rvbench
