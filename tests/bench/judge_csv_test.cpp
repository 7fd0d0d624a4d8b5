#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"

// What `judge` and `check` make of tables that somebody else wrote.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

constexpr double rate_Hz = 2000;
constexpr int rows = 8000;

// A shaft at 1815 rpm that is a little unbalanced, in m/s².
std::vector<double> vibration() {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 0.1);
  std::vector<double> samples;
  for (int i = 0; i < rows; ++i) {
    const double turns = i / rate_Hz * 1815 / 60;
    samples.push_back(0.2 * std::cos(2 * std::numbers::pi * turns) + noise(generator));
  }
  return samples;
}

// A table with this head, whose rows are made of their number and the vibration then; those that
// are empty are left out.
std::string table(const ScratchFolder& scratch, const std::string& head,
                  const std::function<std::string(int, double)>& row) {
  const std::vector<double> x = vibration();
  std::string text = head + "\n";
  for (int i = 0; i < rows; ++i) {
    const std::string line = row(i, x[std::size_t(i)]);
    if (!line.empty()) text += line + "\n";
  }
  const auto file = scratch.path() / "a.csv";
  write_file(file, text);
  return file.string();
}

CommandAnswer judge(const std::string& file, std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {"judge", file, "--kinematics", "cwru_6205", "--json", "--speed", "1815"});
  return rvbench(more);
}

std::vector<std::string> judged_channels(const CommandAnswer& answer) {
  std::vector<std::string> names;
  const auto json = nlohmann::json::parse(answer.out);
  for (const auto& channel : json.at("points").at(0).at("channels")) {
    names.push_back(channel.at("name"));
  }
  return names;
}

// With a column of time, in which `lost` rows are missing from the 4000th on.
std::string timed(const ScratchFolder& scratch, int lost) {
  return table(scratch, "time_s,a", [lost](int i, double x) {
    const bool is_lost = i >= 4000 && i < 4000 + lost;
    return is_lost ? "" : fmt::format("{:.6f},{:.6g}", i / rate_Hz, x);
  });
}

}  // namespace

TEST_CASE("rows that miss in a column of time are refused, whatever rate is given", "[bench]") {
  const ScratchFolder scratch;
  const int lost = GENERATE(1, 20);
  const std::string told = lost == 1
                               ? "about 1 sample is missing behind its sample 4000 (1.9995)"
                               : "about 20 samples are missing behind its sample 4000 (1.9995)";
  const std::string file = timed(scratch, lost);
  for (const auto& rate : {std::vector<std::string>{}, {"--rate", "2000"}}) {
    const CommandAnswer answer = judge(file, rate);
    CHECK(answer.code == 20);
    CHECK_THAT(answer.err, Contains("time_s only rises, as time does, but unevenly: " + told));
  }
  const CommandAnswer asked = judge(file, {"--rate", "2000", "--channel", "a"});
  CHECK_THAT(asked.err, Contains("time_s only rises, as no vibration does, and is left out; it "
                                 "rises unevenly: " +
                                 told));
}

TEST_CASE("a column of time without a gap is no reason to refuse, nor to speak of one", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = timed(scratch, 0);
  for (const auto& rate : {std::vector<std::string>{}, {"--rate", "2000"}}) {
    const CommandAnswer answer = judge(file, rate);
    CHECK(answer.code == 0);
    CHECK_THAT(answer.err, Contains("it says 2000 Hz\n") && !Contains("missing") &&
                               !Contains("not 2000") && !Contains("as given"));
  }
}

TEST_CASE("a rate that a column of time contradicts is told", "[bench]") {
  const ScratchFolder scratch;
  const CommandAnswer even = judge(timed(scratch, 0), {"--rate", "4000"});
  CHECK_THAT(even.err, Contains("rate 4000 Hz as given: the file says 2000 Hz"));
  // Printed in whole milliseconds it states no rate, but means one.
  const CommandAnswer coarse =
      judge(table(scratch, "t [ms],a",
                  [](int i, double x) { return fmt::format("{},{:.6g}", i / 2, x); }),
            {"--rate", "4000"});
  CHECK_THAT(coarse.err, Contains("by the unit in its name it says 2000.25 Hz, not 4000 Hz"));
}

TEST_CASE("what is named as time and does not rise is refused", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = table(scratch, "Time (s),a", [](int i, double x) {
    return fmt::format("{:.6f},{:.6g}", (i % 4000) / rate_Hz, x);
  });
  const CommandAnswer answer = judge(file, {"--rate", "2000"});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err,
             Contains("Time (s) is named as time but does not only rise: 0 follows 1.9995 in "
                      "sample 4001; if it is no time"));
  CHECK(judge(file, {"--rate", "2000", "--channel", "a"}).code == 0);
}

TEST_CASE("only accelerations are judged, by their units, and the others are told", "[bench]") {
  const ScratchFolder scratch;
  const std::string file =
      table(scratch, "a [g],T [degC],U [V],d [furlong],n_rpm,b", [](int, double x) {
        return fmt::format("{0:.6g},{0:.6g},{0:.6g},{0:.6g},{0:.6g},{1:.6g}", x / 9.80665, -x);
      });
  const CommandAnswer answer = judge(file, {"--rate", "2000"});
  CHECK(answer.code == 0);
  CHECK(judged_channels(answer) == std::vector<std::string>{"a", "b"});
  CHECK_THAT(answer.err,
             Contains("note: " + file + ": a: values of the file times 9.80665: into m/s²") &&
                 Contains("T is in °C, no acceleration, and is left out") &&
                 Contains("U is in V, no acceleration as long as nobody says how many volts are "
                          "one, and is left out") &&
                 Contains("d is in furlong, no acceleration, and is left out") &&
                 Contains("n_rpm is in rad/s, no acceleration, and is left out") &&
                 !Contains("b is in"));
}

TEST_CASE("a table without an acceleration is INVALID, and says what it has", "[bench]") {
  const ScratchFolder scratch;
  const std::string head = GENERATE("U [V]", "d [furlong]", "T (degC)");
  const CommandAnswer answer =
      judge(table(scratch, head, [](int, double x) { return fmt::format("{:.6g}", x); }),
            {"--rate", "2000"});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains(" is in ") && Contains("no acceleration"));
  CHECK_THAT(nlohmann::json::parse(answer.out).at("reason").get<std::string>(),
             Contains("no acceleration channel"));
}

TEST_CASE("the unit of a table does not change what is found in it", "[bench]") {
  const ScratchFolder scratch;
  const auto indicators = [&](const std::string& head, double unit) {
    const CommandAnswer answer = judge(
        table(scratch, head, [unit](int, double x) { return fmt::format("{:.9g}", x / unit); }),
        {"--rate", "2000"});
    return nlohmann::json::parse(answer.out).at("points").at(0).at("channels").at(0);
  };
  const auto si = indicators("a [m/s²]", 1);
  for (const auto& other : {indicators("a [g]", 9.80665), indicators("a (mm/s²)", 1e-3)}) {
    CHECK(other.at("name") == si.at("name"));
    CHECK(other.at("unit") == si.at("unit"));
    CHECK(other.at("rms").get<double>() == Approx(si.at("rms").get<double>()));
  }
}

TEST_CASE("a table that is clipped on one side is INVALID, each sample alone or not", "[bench]") {
  const ScratchFolder scratch;
  const std::string file =
      table(scratch, "a", [](int, double x) { return fmt::format("{:.6g}", std::max(x, -0.25)); });
  const CommandAnswer answer = judge(file, {"--rate", "2000"});
  CHECK(answer.code == 20);
  CHECK_THAT(nlohmann::json::parse(answer.out).at("reason").get<std::string>(),
             Contains("a: clipped: "));
  CHECK_THAT(rvbench({"check", file}).err, Contains("warning: " + file + ": a: clipped: "));
}

TEST_CASE("check says what a recording is", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = timed(scratch, 0);
  const CommandAnswer answer = rvbench({"check", file});
  CHECK(answer.code == 0);
  CHECK(answer.out == file + ": CSV, 2 channels (time_s, a), 8000 samples at 2000 Hz: 4 s\n");
  CHECK_THAT(answer.err, !Contains("warning"));
  const std::string bare =
      table(scratch, "a [g]", [](int, double x) { return fmt::format("{:.6g}", x); });
  const CommandAnswer rateless = rvbench({"check", bare});
  CHECK(rateless.code == 0);
  CHECK(rateless.out ==
        bare + ": CSV, 1 channel (a [m/s²]), 8000 samples at a rate that it does not state\n");
  CHECK_THAT(rateless.err, Contains("a: values of the file times 9.80665: into m/s²"));
}

TEST_CASE("check says what is wrong with a recording", "[bench]") {
  const ScratchFolder scratch;
  const CommandAnswer gap = rvbench({"check", timed(scratch, 7)});
  CHECK(gap.code == 0);
  CHECK_THAT(gap.err, Contains("warning: ") && Contains("judge refuses it: time_s only rises") &&
                          Contains("about 7 samples are missing"));
  const CommandAnswer lost = rvbench({"check", table(scratch, "a", [](int i, double x) {
                                        return i % 1000 == 9 ? "nan" : fmt::format("{:.6g}", x);
                                      })});
  CHECK_THAT(lost.err, Contains("a: lost samples: 8 of 8000"));
  const auto bad = scratch.path() / "bad.csv";
  write_file(bad, "a;b\n1,5;2\n1;x\n");
  const CommandAnswer refused = rvbench({"check", bad.string()});
  CHECK(refused.code == 20);
  CHECK_THAT(refused.err, Contains("bad.csv: 3:2: \"x\" is not a number"));
  CHECK(refused.out.empty());
}

TEST_CASE("check still reads JSON that is broken as JSON", "[bench]") {
  const ScratchFolder scratch;
  const std::string name = GENERATE("a.json", "a.txt", "a.csv");
  const auto file = scratch.path() / name;
  write_file(file, R"({"main": [1, 2}, "name": "x")");
  const CommandAnswer answer = rvbench({"check", file.string()});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains(name + ":1:"));
}

}  // namespace rvbench::bench
