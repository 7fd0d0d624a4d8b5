#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <thread>

#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "hal/recording_file.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::Program;
using test::ScratchFolder;

// Ten points, so that there is time to interfere: each is a tenth of the way, and 16 s of the
// rig's time.
void write_long_plan(const ScratchFolder& scratch) {
  bench::write_file(scratch.path() / "long.json",
                    test::replaced(test::short_plan, "\"speeds_rpm\": [1210]",
                                   "\"speeds_rpm\": [1815], \"repeats\": 10"));
}

std::vector<std::string> run_words(const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{test::rvbench_path(), "run", "long.json", "--rig", "sim",
                                 "--serial",           "A17"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::filesystem::path only_run(const ScratchFolder& scratch) {
  const std::filesystem::directory_iterator runs(scratch.path() / "runs" / "A17");
  REQUIRE(runs != std::filesystem::directory_iterator());
  return runs->path();
}

nlohmann::json verdict_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(bench::read_file(folder / "verdict.json").value_or("null"));
}

// Ten seconds of a shaft at 1800 rpm, in noise.
void write_recording(const std::filesystem::path& file, unsigned seed) {
  constexpr double rate_Hz = 2000;
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, 0.1);
  std::ofstream out(file);
  out << "accel_1x\n";
  for (int i = 0; i < 10 * rate_Hz; ++i) {
    out << std::sin(2 * std::numbers::pi * 30 * i / rate_Hz) + noise(generator) << '\n';
  }
}

}  // namespace

TEST_CASE("a program that has ended is sent no signal, and nobody else in its place", "[spec]") {
  const ScratchFolder scratch;
  Program program(scratch.path(), {"/bin/true"});
  CHECK_FALSE(program.says("a word"));
  CHECK_FALSE(program.send(0));  // 0 only asks whether there is somebody
}

TEST_CASE("a signal ends a run ABORTED, with the shaft stopped and the folder whole",
          "[spec][safety]") {
  for (const auto& [name, signal, times] : {std::tuple{"Ctrl-C", SIGINT, 1},
                                            {"Ctrl-C twice", SIGINT, 2},
                                            {"SIGTERM", SIGTERM, 1},
                                            {"the terminal is gone", SIGHUP, 1},
                                            {"Ctrl-\\", SIGQUIT, 1},
                                            {"a signal of somebody else's", SIGUSR1, 1}}) {
    for (const char* moment : {"warm up at", "measure: 10 %"}) {
      DYNAMIC_SECTION(name << " during " << moment) {
        const ScratchFolder scratch;
        write_long_plan(scratch);
        Program program(scratch.path(), run_words());
        REQUIRE(program.says(moment));
        for (int i = 0; i < times; ++i) program.send(signal);
        const Answer answer = program.wait();
        INFO(answer.err);
        CHECK(answer.code == 50);
        CHECK_THAT(answer.out, Contains("ABORTED"));
        CHECK_THAT(answer.out, Contains("stopped on request"));
        const auto folder = only_run(scratch);
        const nlohmann::json verdict = verdict_of(folder);
        CHECK(verdict.at("verdict") == "ABORTED");
        CHECK(verdict.at("run").at("shaft_stopped") == true);
        CHECK(verdict.at("run").at("brake_released") == true);
        CHECK(bench::verify_sums(folder).empty());
        CHECK(hal::RecordingReader::open(folder / "recording.h5"));
        CHECK(test::rvbench(scratch.path(), {"check", folder.string()}).code == 0);
      }
    }
  }
}

TEST_CASE("a signal ends an answer before it is there, and leaves no folder that looks like one",
          "[spec]") {
  const ScratchFolder scratch;
  for (const char* side : {"a", "b"}) {
    std::filesystem::create_directory(scratch.path() / side);
    for (unsigned i = 0; i < 40; ++i) {  // no two alike: a copy is not measured again
      write_recording(scratch.path() / side / (std::to_string(i) + ".csv"), i);
    }
  }
  const std::vector<std::string> said{"--kinematics", "cwru_6205", "--rate", "2000",
                                      "--speed",      "1800",      "--out",  "made/out"};
  const auto stopped = [&](std::vector<std::string> words, const char* moment, int signal) {
    words.insert(words.begin(), test::rvbench_path());
    words.insert(words.end(), said.begin(), said.end());
    Program program(scratch.path(), words);
    REQUIRE(program.says(moment));
    program.send(signal);
    return program.wait();
  };
  std::vector<std::string> judge{"judge"};
  for (int i = 0; i < 40; ++i) judge.push_back("a/" + std::to_string(i) + ".csv");
  for (const int signal : {SIGINT, SIGTERM}) {
    const Answer judged = stopped(judge, "judge: 10 %", signal);
    CHECK(judged.code == 50);
    CHECK_THAT(judged.err, Contains("judge: interrupted; nothing was written"));
    CHECK(judged.out.empty());
    CHECK_FALSE(std::filesystem::exists(scratch.path() / "made"));
  }
  const Answer compared = stopped({"compare", "a", "b"}, "measure A: 10 %", SIGINT);
  CHECK(compared.code == 50);
  CHECK_THAT(compared.err, Contains("compare: interrupted; nothing was written"));
  CHECK(compared.out.empty());
  CHECK_FALSE(std::filesystem::exists(scratch.path() / "made"));
}

TEST_CASE("whenever a signal comes, there is the whole answer or none", "[spec]") {
  const ScratchFolder scratch;
  write_recording(scratch.path() / "a.csv", 1);
  write_recording(scratch.path() / "b.csv", 2);
  const auto out = scratch.path() / "made" / "out";
  const auto [words, moment, files] =
      GENERATE(table<std::vector<std::string>, const char*, std::vector<std::string>>(
          {{{"judge", "a.csv"}, "judge: 0 %", {"verdict.json", "report.html"}},
           {{"compare", "a.csv", "b.csv"}, "measure A: 0 %", {"compare.json", "compare.html"}}}));
  std::vector<std::string> all{test::rvbench_path()};
  all.insert(all.end(), words.begin(), words.end());
  all.insert(all.end(), {"--kinematics", "cwru_6205", "--rate", "2000", "--speed", "1800", "--out",
                         "made/out"});
  for (const int wait_ms : {0, 20, 50, 100, 200, 400}) {
    Program program(scratch.path(), all);
    REQUIRE(program.says(moment));
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    program.send(SIGINT);
    const Answer answer = program.wait();
    CAPTURE(words.front(), wait_ms, answer.code, answer.err);
    CHECK((answer.code == 0 || answer.code == 50));
    const bool whole = std::filesystem::exists(out);
    if (answer.code == 0) CHECK(whole);
    if (!whole) CHECK_FALSE(std::filesystem::exists(scratch.path() / "made"));
    for (const std::string& file : files) CHECK(std::filesystem::exists(out / file) == whole);
    std::filesystem::remove_all(scratch.path() / "made");
  }
}

TEST_CASE("a run that is stopped while it judges claims no verdict, and advises nothing",
          "[spec]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder scratch;
  write_long_plan(scratch);
  Program program(scratch.path(), run_words({"--preset", "input_shaft"}));
  REQUIRE(program.says("judge: 40 %"));
  program.send(SIGINT);
  const Answer answer = program.wait();
  CHECK(answer.code == 50);
  const auto folder = only_run(scratch);
  CHECK(verdict_of(folder).at("verdict") == "ABORTED");
  CHECK(verdict_of(folder).at("findings_stand") == false);
  CHECK_FALSE(verdict_of(folder).at("findings").empty());  // of the points that were judged
  const std::string log = bench::read_file(folder / "log.jsonl").value();
  CHECK_THAT(log, Contains("ABORTED: stopped by the operator while judging"));
  const std::string page = bench::read_file(folder / "report.html").value();
  CHECK((page.find("<dt>Advice") == std::string::npos));  // not printed: a report is long
  for (const std::string& told :
       {answer.out, log, page, bench::read_file(folder / "junit.xml").value()}) {
    CHECK((told.find("PASS") == std::string::npos));
    CHECK((told.find("FAIL") == std::string::npos));
    CHECK((told.find("advice: ") == std::string::npos));
  }
}

TEST_CASE("a run that was started to outlive its terminal does", "[spec]") {
  const ScratchFolder scratch;
  write_long_plan(scratch);
  std::vector<std::string> words = run_words();
  words.insert(words.begin(), "/usr/bin/nohup");
  Program program(scratch.path(), words);
  REQUIRE(program.says("warm up at"));
  program.send(SIGHUP);
  REQUIRE(program.says("measure: 20 %"));
  program.send(SIGINT);
  CHECK(program.wait().code == 50);
}

TEST_CASE("a killed run leaves its samples, is told from a finished one, and can go on",
          "[spec][safety]") {
  const ScratchFolder scratch;
  write_long_plan(scratch);
  {
    Program program(scratch.path(), run_words());
    REQUIRE(program.says("measure: 30 %"));
    program.send(SIGKILL);
    REQUIRE(program.wait().code == -SIGKILL);
  }
  const auto folder = only_run(scratch);
  const Answer check = test::rvbench(scratch.path(), {"check", folder.string()});
  CHECK(check.code == 3);
  CHECK_THAT(check.err, Contains("SHA256SUMS: missing; the run did not finish"));

  const Answer judge =
      test::rvbench(scratch.path(), {"judge", (folder / "recording.h5").string(), "--kinematics",
                                     "rv20e", "--channel", "accel_1x", "--json"});
  INFO(judge.err);
  CHECK((judge.code == 0 || judge.code == 20));
  const auto json = nlohmann::json::parse(judge.out);
  CHECK(json.at("points").at(1).at("status") == "ok");
  CHECK(json.at("points").size() < 10);

  Program resumed(scratch.path(), run_words({"--resume"}));
  REQUIRE(resumed.says("measure: 50 %"));
  resumed.send(SIGINT);
  CHECK(resumed.wait().code == 50);
  CHECK_THAT(bench::read_file(folder / "log.jsonl").value(),
             Contains("of 10; the rig's time starts again"));
  const nlohmann::json verdict = verdict_of(folder);
  CHECK(verdict.at("run").at("resumed_at_point") >= 2);
  CHECK(verdict.at("points").at(1).at("status") == "not_judged");
  CHECK(bench::verify_sums(folder).empty());
}

TEST_CASE("a resume beside the live run is refused, and touches nothing", "[spec][safety]") {
  const ScratchFolder scratch;
  write_long_plan(scratch);
  Program live(scratch.path(), run_words());
  REQUIRE(live.says("measure: 10 %"));
  std::vector<std::string> words = run_words({"--resume", "--json"});
  words.erase(words.begin());
  const Answer second = test::rvbench(scratch.path(), words);
  CHECK(second.code == 2);
  CHECK_THAT(second.err, Contains("another rvbench is at work in"));
  CHECK(nlohmann::json::parse(second.out).at("exit_code") == 2);
  CHECK_FALSE(std::filesystem::exists(only_run(scratch) / "verdict.json"));
  live.send(SIGINT);
  CHECK(live.wait().code == 50);
}

TEST_CASE("a resume that is stopped before its first record leaves no recording", "[spec]") {
  const ScratchFolder scratch;
  write_long_plan(scratch);
  {
    Program program(scratch.path(), run_words());
    REQUIRE(program.says("measure: 20 %"));
    program.send(SIGKILL);
    program.wait();
  }
  const auto folder = only_run(scratch);
  Program resumed(scratch.path(), run_words({"--resume"}));
  REQUIRE(resumed.says("warm up at"));
  SECTION("stopped") { resumed.send(SIGINT); }
  SECTION("killed, and resumed again") {
    resumed.send(SIGKILL);
    resumed.wait();
    Program again(scratch.path(), run_words({"--resume"}));
    REQUIRE(again.says("warm up at"));
    again.send(SIGINT);
    CHECK(again.wait().code == 50);
  }
  resumed.wait();
  CHECK(std::filesystem::exists(folder / "recording.h5"));
  CHECK_FALSE(std::filesystem::exists(folder / "recording-2.h5"));
  CHECK_FALSE(std::filesystem::exists(folder / "recording-3.h5"));
}

TEST_CASE("a run goes on when nobody reads its progress any more", "[spec][safety]") {
  const ScratchFolder scratch;
  bench::write_file(scratch.path() / "short.json", test::unsettled_plan());
  // The reading end of the pipe closes after the first line.
  Program program(scratch.path(), {"/bin/sh", "-c",
                                   "{ \"$0\" run short.json --rig sim --serial A17 > out; "
                                   "echo $? > code; } 2>&1 | head -n 1",
                                   test::rvbench_path()});
  program.wait();
  CHECK(bench::read_file(scratch.path() / "code") == "20\n");
  CHECK(verdict_of(only_run(scratch)).at("verdict") == "INVALID");
}

}  // namespace rvbench
