#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::ScratchFolder;

const std::vector<std::string> run_short{"run",      "short.json", "--rig", "sim",
                                         "--serial", "A17",        "--json"};

Answer run(const ScratchFolder& scratch, const std::string& plan,
           const std::vector<std::string>& words = run_short) {
  bench::write_file(scratch.path() / "short.json", plan);
  return test::rvbench(scratch.path(), words);
}

// What a run printed agrees with its exit code.
void check_verdict(const Answer& answer, int code, const std::string& verdict) {
  INFO(answer.err);
  CHECK(answer.code == code);
  const auto json = nlohmann::json::parse(answer.out);
  CHECK(json.at("verdict") == verdict);
  CHECK(json.at("exit_code") == code);
}

// Runs rvbench where no file may grow beyond so many bytes: a disk that is full.
Answer run_on_full_disk(const ScratchFolder& scratch, int kilobytes) {
  bench::write_file(scratch.path() / "short.json", test::short_plan);
  std::vector<std::string> words{"/bin/sh", "-c", "ulimit -f $0; exec \"$@\"",
                                 std::to_string(2 * kilobytes),  // sh counts blocks of 512 bytes
                                 test::rvbench_path()};
  words.insert(words.end(), run_short.begin(), run_short.end());
  return test::Program(scratch.path(), words).wait();
}

std::filesystem::path only_run(const ScratchFolder& scratch) {
  return std::filesystem::directory_iterator(scratch.path() / "runs" / "A17")->path();
}

// What could not be written is named on standard error, and no half of it is left.
void check_missing_are_named(const std::filesystem::path& folder, const Answer& answer) {
  INFO(answer.err);
  CHECK_THAT(answer.err, Contains("not written: report.html: File too large"));
  for (const std::string name : {"verdict.json", "report.html", "junit.xml", "SHA256SUMS"}) {
    CAPTURE(name);
    const bool is_there = std::filesystem::exists(folder / name);
    CHECK(is_there == (answer.err.find("not written: " + name) == std::string::npos));
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    CHECK(bench::drafted_file(entry.path()).empty());
  }
  // What is there agrees with the exit code.
  const auto verdict = bench::read_file(folder / "verdict.json");
  if (verdict) CHECK_THAT(*verdict, Contains("\"exit_code\": 30"));
}

// At full speed, which makes the shortest record.
std::string limited(const std::string& max_g) {
  return test::replaced(test::replaced(test::short_plan, "[1210]", "[1815]"), "\"main\"",
                        "\"limits\": [{\"measure\": \"acceleration_peak\", \"unit\": \"g\", "
                        "\"max\": " +
                            max_g + ", \"why\": \"spec\"}], \"main\"");
}

}  // namespace

TEST_CASE("0: a healthy unit passes", "[spec][exit_code]") {
  check_verdict(run(ScratchFolder(), limited("1.0")), 0, "PASS");
}

TEST_CASE("10: a unit beyond a limit of the plan fails", "[spec][exit_code]") {
  check_verdict(run(ScratchFolder(), limited("0.001")), 10, "FAIL");
}

TEST_CASE("20: what does not settle is INVALID", "[spec][exit_code]") {
  check_verdict(run(ScratchFolder(), test::unsettled_plan()), 20, "INVALID");
}

TEST_CASE("30: a lost drive is an ERROR", "[spec][exit_code]") {
  const ScratchFolder scratch;
  bench::write_file(scratch.path() / "rig.json",
                    R"({"rig": "sim", "preset": "planet_tooth", "seed": 3, "faults": [
                       {"at_s": 2, "device": "inverter", "fault": "dead"}]})");
  std::vector<std::string> words = run_short;
  words[3] = "rig.json";
  const Answer answer = run(scratch, test::short_plan, words);
  check_verdict(answer, 30, "ERROR");
  const auto verdict = nlohmann::json::parse(answer.out);
  CHECK(verdict.at("error_kind") == "device_lost");
  CHECK(verdict.at("run").at("preset") == "planet_tooth");  // as the rig file has it
  CHECK(verdict.at("seed") == 3);
}

TEST_CASE("40: a value beyond an interlock is a safety trip", "[spec][exit_code]") {
  const Answer answer =
      run(ScratchFolder(),
          test::replaced(test::short_plan, "\"input_torque_Nm\": 8", "\"input_torque_Nm\": 0.9"));
  check_verdict(answer, 40, "ERROR");
  CHECK(nlohmann::json::parse(answer.out).at("error_kind") == "safety_trip");
}

TEST_CASE("2: a command line that makes no sense", "[spec][exit_code]") {
  const ScratchFolder scratch;
  const Answer answer = test::rvbench(scratch.path(), {"run", "quick", "--rig", "sim"});
  CHECK(answer.code == 2);
  CHECK(answer.out.empty());
  CHECK_THAT(answer.err, Contains("--serial is required"));
  CHECK(std::filesystem::is_empty(scratch.path()));
}

TEST_CASE("2: a folder that cannot be written to is said before anything turns",
          "[spec][exit_code]") {
  const ScratchFolder scratch;
  bench::write_file(scratch.path() / "file", "");
  for (const char* out : {"file", "/proc/rvbench"}) {
    std::vector<std::string> words = run_short;
    words.insert(words.end(), {"--out", out});
    const Answer answer = run(scratch, test::short_plan, words);
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains(std::string("--out ") + out));
    bench::write_file(scratch.path() / "a.csv", "a,b\n1,2\n");
    const Answer judged =
        test::rvbench(scratch.path(), {"judge", "a.csv", "--kinematics", "rv20e", "--rate", "1000",
                                       "--speed", "600", "--out", out});
    CHECK(judged.code == 2);
    CHECK_THAT(judged.err, Contains(std::string("--out ") + out));
  }
}

TEST_CASE("a full disk is an ERROR of the bench, told even if nothing can be written down",
          "[spec][exit_code]") {
  const ScratchFolder scratch;
  SECTION("full before the run") {
    const Answer answer = run_on_full_disk(scratch, 1);
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("plan.json") && Contains("File too large"));
  }
  SECTION("full before the results") {
    const Answer answer = run_on_full_disk(scratch, 10);
    check_verdict(answer, 30, "ERROR");
    check_missing_are_named(only_run(scratch), answer);
  }
  SECTION("full during the record") {
    check_verdict(run_on_full_disk(scratch, 500), 30, "ERROR");
    const auto folder = only_run(scratch);
    CHECK(bench::verify_sums(folder).empty());
    CHECK_THAT(bench::read_file(folder / "verdict.json").value(),
               Contains("the recording cannot be written"));
  }
}

TEST_CASE("1: an answer that could not be delivered is no success", "[spec][exit_code]") {
  const ScratchFolder scratch;
  bench::write_file(scratch.path() / "short.json", test::short_plan);
  const std::string nowhere = GENERATE("> /dev/full", ">&-");
  CAPTURE(nowhere);
  const Answer answer =
      test::Program(scratch.path(), {"/bin/sh", "-c", "exec \"$0\" check short.json " + nowhere,
                                     test::rvbench_path()})
          .wait();
  CHECK(answer.code == 1);
  CHECK_THAT(answer.err, Contains("standard output cannot be written"));
}

TEST_CASE("3: a run folder whose recording was cut is told, and nothing judges it",
          "[spec][exit_code]") {
  const ScratchFolder scratch;
  REQUIRE(run(scratch, test::unsettled_plan()).code == 20);
  const std::filesystem::path folder = only_run(scratch);
  const std::string whole = bench::read_file(folder / "recording.h5").value();
  bench::write_file(folder / "recording.h5", whole.substr(0, whole.size() / 2));
  CHECK_THAT(test::rvbench(scratch.path(), {"check", folder.string()}).err,
             Contains("recording.h5: does not match its hash"));
  CHECK(test::rvbench(scratch.path(), {"report", folder.string()}).code == 3);
  CHECK(test::rvbench(scratch.path(),
                      {"judge", (folder / "recording.h5").string(), "--kinematics", "rv20e"})
            .code == 20);
}

TEST_CASE("what libiio says of a front end is told in the reason, and nowhere else", "[spec]") {
  const ScratchFolder scratch;
  auto rig = nlohmann::json::parse(
      bench::read_file(test::source_dir() / "bench/rigs/rv20e_bench.json").value());
  rig["drive"]["tcp"] = {{"host", "127.0.0.1"}, {"port", 1}};
  rig["safety"]["tcp"] = rig["drive"]["tcp"];
  rig["safety"]["unit_id"] = 2;
  rig["can"]["slcan"]["device"] = "no_adapter";
  rig["accelerometers"]["uri"] = "usb:";
  bench::write_file(scratch.path() / "rig.json", rig.dump());
  const Answer answer = run(scratch, test::short_plan,
                            {"run", "short.json", "--rig", "rig.json", "--serial", "A", "--json"});
  check_verdict(answer, 30, "ERROR");
  CHECK_THAT(nlohmann::json::parse(answer.out).at("reason").get<std::string>(),
             Contains("accelerometers usb:: connect: ") && Contains("Bad URI: 'usb:'"));
  CHECK(answer.err.empty());
}

TEST_CASE("any serial number makes a folder of its own inside --out", "[spec]") {
  const ScratchFolder scratch;
  const std::vector<std::string> serials{
      "../up", "/etc", "..", ".", "a/b", "a_b", "Prüfling 7", "-x", std::string(300, 'x')};
  for (const std::string& serial : serials) {
    CAPTURE(serial);
    CHECK(run(scratch, test::unsettled_plan(),
              {"run", "short.json", "--rig", "sim", "--serial=" + serial, "--out", "out", "--json"})
              .code == 20);
  }
  std::size_t folders = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path() / "out")) {
    if (entry.path().filename() == "results.db") continue;
    CHECK(entry.path().filename().string().size() < 100);
    CHECK_FALSE(std::filesystem::is_empty(entry));
    ++folders;
  }
  CHECK(folders == serials.size());
}

}  // namespace rvbench
