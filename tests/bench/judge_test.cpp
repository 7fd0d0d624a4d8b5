#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/hal/mat5_builder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

// What `judge` makes of what the user says about a recording, right and wrong.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

constexpr double rate_Hz = 2000;
constexpr double speed_rpm = 1815;

// A channel "a" at 2 kHz: noise, and what `signal` is at an angle of the shaft in turns.
template <typename Signal>
std::string recorded(const ScratchFolder& scratch, double length_s, Signal signal,
                     double unit = 1) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 0.1);
  const auto file = scratch.path() / "a.csv";
  std::ofstream out(file);
  out << "a\n";
  for (int i = 0; i < length_s * rate_Hz; ++i) {
    out << unit * (signal(i / rate_Hz * speed_rpm / 60) + noise(generator)) << '\n';
  }
  return file.string();
}

double tone(double order, double turns) { return std::cos(2 * std::numbers::pi * order * turns); }

// A shaft that is a little unbalanced.
std::string unbalanced(const ScratchFolder& scratch) {
  return recorded(scratch, 4, [](double turns) { return 0.2 * tone(1, turns); });
}

// The same, 4 s long, beside a column "t" that holds what a clock shows at a time.
std::string timed(const ScratchFolder& scratch, double (*clock_s)(double t_s)) {
  std::ifstream in(unbalanced(scratch));
  const auto file = scratch.path() / "timed.csv";
  std::ofstream out(file);
  std::string value;
  std::getline(in, value);
  out << "t,a\n";
  for (int i = 0; std::getline(in, value); ++i) out << clock_s(i / rate_Hz) << ',' << value << '\n';
  return file.string();
}

// An RV-20E with a damaged planet: its mesh swings twice and three times per
// turn of the planet against the carrier, 40/121 of the shaft's.
std::string damaged_planet(const ScratchFolder& scratch) {
  return recorded(scratch, 17, [](double turns) {
    const double swing = 0.5 * tone(80.0 / 121, turns) + 0.5 * tone(120.0 / 121, turns);
    const double mesh = 1080.0 / 121;
    return 0.2 * tone(1, turns) + (1 + swing) * (0.3 * tone(mesh, turns) + tone(2 * mesh, turns) +
                                                 0.4 * tone(3 * mesh, turns));
  });
}

CommandAnswer judge(const std::string& file, const std::string& machine,
                    std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"judge", file, "--kinematics", machine, "--json"});
  return rvbench(more);
}

const std::vector<std::string> right{"--rate", "2000", "--speed", "1815"};

bool notes(const CommandAnswer& answer, const std::string& what) {
  const auto verdict = nlohmann::json::parse(answer.out);
  for (const auto& note : verdict.at("quality")) {
    if (note.at("what").get<std::string>().find(what) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("what is judged at a wrong speed, rate or machine is INVALID, not PASS", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = unbalanced(scratch);
  CHECK(judge(file, "cwru_6205", right).code == 0);
  const auto wrong = GENERATE(values<std::vector<std::string>>({
      {"--rate", "2000", "--speed", "1600"},
      {"--rate", "2000", "--speed", "900"},
      {"--rate", "1700", "--speed", "1815"},
      {"--rate", "48000", "--speed", "1815"},
  }));
  CAPTURE(wrong);
  const CommandAnswer answer = judge(file, "cwru_6205", wrong);
  CHECK(answer.code == 20);
  CHECK(notes(answer, "cannot tell: no line of this machine"));
}

TEST_CASE("a machine whose own lines are not in the data is INVALID, though its shaft's is",
          "[bench]") {
  const ScratchFolder scratch;
  const std::string file = unbalanced(scratch);
  for (const char* machine : {"gear0", "two_stage"}) {
    const CommandAnswer answer = judge(file, machine, right);
    CHECK(answer.code == 20);
    CHECK(notes(answer, "no line is in the data but those of its input shaft"));
  }
}

TEST_CASE("within a motor's slip the speed that the machine's lines fit is taken, and told",
          "[bench]") {
  const ScratchFolder scratch;
  const std::string file =
      recorded(scratch, 17, [](double turns) { return 0.2 * tone(1, turns) + tone(23, turns); });
  CHECK(judge(file, "gear0", right).code == 0);
  const CommandAnswer answer = judge(file, "gear0", {"--rate", "2000", "--speed", "1800"});
  CHECK(answer.code == 0);
  CHECK(notes(answer, "judged at 1815"));
  CHECK(nlohmann::json::parse(answer.out).at("points").at(0).at("speed_rpm") ==
        Approx(1815).epsilon(1e-4));
  // Beyond it is another drive, or another rate.
  const CommandAnswer far = judge(file, "gear0", {"--rate", "2000", "--speed", "1740"});
  CHECK(far.code == 20);
  CHECK(notes(far, "at 1815"));
}

TEST_CASE("a speed that is a motor's slip off the file's stays in force, and is told", "[bench]") {
  const ScratchFolder scratch;
  std::vector<double> samples;
  for (int i = 0; i < 8000; ++i) samples.push_back(tone(1, i / rate_Hz * speed_rpm / 60) + i % 7);
  const std::string file = (scratch.path() / "a.mat").string();
  write_file(file, rvbench::test::mat5_file({rvbench::test::mat5_array("x", 8000, 1, samples),
                                             rvbench::test::mat5_array("XRPM", 1, 1, {1815})}));
  const std::string told = "speed 1750 rpm as given: the file says 1815 rpm";
  const CommandAnswer answer = judge(file, "cwru_6205", {"--rate", "2000", "--speed", "1750"});
  CHECK_THAT(answer.err, Contains(told));
  CHECK(notes(answer, told));
  CHECK(nlohmann::json::parse(answer.out).at("points").at(0).at("speed_rpm") == 1750);
  const CommandAnswer nominal = judge(file, "cwru_6205", {"--rate", "2000", "--speed", "1800"});
  CHECK_THAT(nominal.err, !Contains("as given"));  // within 1 %
  // Two thirds: order 2 would be taken for order 3, and one race for the other.
  const CommandAnswer wrong = judge(file, "cwru_6205", {"--rate", "2000", "--speed", "1210"});
  CHECK(wrong.code == 20);
  CHECK_THAT(wrong.err,
             Contains("a.mat: says 1815 rpm, 1210 rpm were given: one of them is wrong"));
}

TEST_CASE("a rate at which the shaft could not be seen is refused before the analysis", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = unbalanced(scratch);
  for (const char* rate : {"2", "60.5"}) {
    const CommandAnswer answer = judge(file, "cwru_6205", {"--rate", rate, "--speed", "1815"});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("turns 30.25 times a second") && Contains("is --rate in Hz"));
  }
}

TEST_CASE("a channel that is not there is answered with those that are", "[bench]") {
  const ScratchFolder scratch;
  const auto file = scratch.path() / "two.csv";
  std::ofstream(file) << "accel_1x,accel_1y\n1,2\n2,3\n";
  const CommandAnswer answer =
      judge(file.string(), "rv20e", {"--rate", "2000", "--speed", "605", "--channel", "acel_1x"});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err,
             Contains("there are: accel_1x, accel_1y") && Contains("did you mean \"accel_1x\"?"));
}

TEST_CASE("a column that only rises is time, not vibration", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = timed(scratch, [](double t_s) { return std::round(1e3 * t_s) / 1e3; });
  // A clock of whole milliseconds: 7999 steps in 4.000 s.
  const std::string told =
      "t only rises, as no vibration does, and is left out; in seconds it "
      "says 1999.75 Hz";
  const CommandAnswer answer = judge(file, "cwru_6205", right);
  CHECK(answer.code == 0);
  const auto channels = nlohmann::json::parse(answer.out).at("points").at(0).at("channels");
  REQUIRE(channels.size() == 1);
  CHECK(channels.at(0).at("name") == "a");
  CHECK(notes(answer, told));
  const CommandAnswer no_rate = judge(file, "cwru_6205", {"--speed", "1815"});
  CHECK(no_rate.code == 2);
  CHECK_THAT(no_rate.err, Contains("give it with --rate HZ (" + told + ")"));
}

TEST_CASE("a column of time is read in the unit that its name ends in", "[bench]") {
  const ScratchFolder scratch;
  const auto [name, per_s] = GENERATE(table<std::string, double>(
      {{"time_ms", 1e3}, {"time_us", 1e6}, {"t [ms]", 1e3}, {"time (µs)", 1e6}, {"time_s", 1}}));
  CAPTURE(name);
  const auto file = scratch.path() / "timed.csv";
  std::ofstream out(file);
  out << name << ",a\n";
  for (int i = 0; i < 1000; ++i) {
    out << i * per_s / rate_Hz << ',' << std::sin(i) << '\n';
  }
  out.close();
  CHECK_THAT(judge(file.string(), "cwru_6205", {"--speed", "1815"}).err,
             Contains(name + " only rises, as no vibration does, and is left out; by the unit "
                             "in its name it says 2000 Hz"));
}

TEST_CASE("a velocity is not judged as an acceleration", "[bench]") {
  const ScratchFolder scratch;
  const auto [head, name] = GENERATE(
      table<std::string, std::string>({{"v [mm/s]", "v"}, {"v_mm/s", "v_mm/s"}, {"v (m/s)", "v"}}));
  CAPTURE(head);
  std::ifstream in(unbalanced(scratch));
  const auto file = scratch.path() / "v.csv";
  std::ofstream out(file);
  std::string line;
  std::getline(in, line);
  out << head << ",a\n";
  while (std::getline(in, line)) out << line << ',' << line << '\n';
  out.close();
  const CommandAnswer answer = judge(file.string(), "cwru_6205", right);
  const auto channels = nlohmann::json::parse(answer.out).at("points").at(0).at("channels");
  REQUIRE(channels.size() == 1);
  CHECK(channels.at(0).at("name") == "a");
  CHECK_THAT(answer.err, Contains(name + " is in m/s, no acceleration, and is left out"));
}

TEST_CASE("a speed that the file states and that is none is told", "[bench]") {
  const ScratchFolder scratch;
  const double stated_rpm = GENERATE(0.0, -1797.0);
  const auto file = scratch.path() / "a.mat";
  std::ofstream(file, std::ios::binary)
      << rvbench::test::mat5_file({rvbench::test::mat5_array("x", 3, 1, {1, 2, 3}),
                                   rvbench::test::mat5_array("X105RPM", 1, 1, {stated_rpm})});
  const CommandAnswer answer = judge(file.string(), "cwru_6205", {"--rate", "12000"});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("give it with --speed RPM (X105RPM: ") &&
                             Contains(" is no speed of a shaft that turns forward"));
}

TEST_CASE("time that jumps is no single rate: INVALID, unless a channel is asked for", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = timed(scratch, [](double t_s) { return t_s < 2 ? t_s : t_s + 0.1; });
  const CommandAnswer answer = judge(file, "cwru_6205", right);
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err,
             Contains("t only rises, as time does, but unevenly: about 200 samples are missing"));
  std::vector<std::string> words = right;
  words.insert(words.end(), {"--channel", "a"});
  const CommandAnswer asked = judge(file, "cwru_6205", words);
  CHECK(asked.code == 0);
  CHECK(notes(asked, "t only rises, as no vibration does, and is left out"));
}

TEST_CASE("samples beyond any unit are INVALID, not an internal error", "[bench]") {
  const ScratchFolder scratch;
  for (const double unit : {1e300, 1e-300}) {
    const std::string file = recorded(
        scratch, 4, [](double turns) { return 0.2 * tone(1, turns); }, unit);
    const CommandAnswer answer = judge(file, "cwru_6205", right);
    CHECK(answer.code == 20);
    CHECK_THAT(answer.err, Contains("a: its largest sample") && Contains("no vibration"));
  }
  const std::string file = recorded(
      scratch, 4, [](double turns) { return 0.2 * tone(1, turns); }, 1e-12);
  CHECK(judge(file, "cwru_6205", right).code == 0);
}

TEST_CASE("what the published Table 4 misses is INVALID, not PASS", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = damaged_planet(scratch);
  const CommandAnswer derived = judge(file, "rv20e", right);
  CHECK(derived.code == 10);
  const auto verdict = nlohmann::json::parse(derived.out);
  CHECK(verdict.at("findings").at(0).at("component") == "planet_gear");

  std::vector<std::string> published = right;
  published.insert(published.end(), {"--catalogue", "published"});
  const CommandAnswer answer = judge(file, "rv20e", published);
  CHECK(answer.code == 20);
  CHECK_THAT(nlohmann::json::parse(answer.out).at("reason").get<std::string>(),
             Contains("Table 4 as published does not hold the lines of planet_gear"));
}

TEST_CASE("the published Table 4 is of one machine, and needs a speed", "[bench]") {
  const ScratchFolder scratch;
  for (const char* machine : {"cwru_6205", "gear0", "two_stage"}) {
    const CommandAnswer answer =
        rvbench({"judge", unbalanced(scratch), "--kinematics", machine, "--rate", "2000", "--speed",
                 "1815", "--catalogue", "published"});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("Table 4 of the RV-20E"));
  }
  // The same gears by another name are the same machine, with another tooth count not.
  const auto own = scratch.path() / "own.json";
  const std::string text = R"({"machine": "our reducer", "rv_reducer": {"sun_teeth": 9,
    "planet_teeth": 27, "planets": 3, "lobes": 39, "pins": 40}})";
  write_file(own, text);
  std::vector<std::string> published = right;
  published.insert(published.end(), {"--catalogue", "published"});
  CHECK(judge(unbalanced(scratch), own.string(), published).code == 20);  // 4 s are too short
  write_file(own, std::string(text).replace(text.find("27"), 2, "28"));
  CHECK(judge(unbalanced(scratch), own.string(), published).code == 2);
}

TEST_CASE("judge does not write over an older verdict", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = unbalanced(scratch);
  std::vector<std::string> words = right;
  words.insert(words.end(), {"--out", (scratch.path() / "judged").string()});
  CHECK(judge(file, "cwru_6205", words).code == 0);
  const std::string verdict = read_file(scratch.path() / "judged" / "verdict.json").value();
  words[3] = "1600";
  const CommandAnswer again = judge(file, "cwru_6205", words);
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("holds a verdict.json already"));
  CHECK(read_file(scratch.path() / "judged" / "verdict.json") == verdict);
}

TEST_CASE("a result that judge cannot write is an ERROR that names it", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = unbalanced(scratch);
  const auto out = scratch.path() / "judged";
  std::vector<std::string> words = right;
  words.insert(words.end(), {"--out", out.string()});
  const test::FileSizeLimit room_for_a_verdict(60000);
  const CommandAnswer answer = judge(file, "cwru_6205", words);
  CHECK(answer.code == 30);
  CHECK_THAT(answer.err, Contains("not written: report.html: File too large"));
  CHECK(nlohmann::json::parse(answer.out).at("exit_code") == 30);
  CHECK(read_file(out / "verdict.json") == answer.out);
}

}  // namespace rvbench::bench
