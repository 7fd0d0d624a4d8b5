#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/text_file.hpp"
#include "sim/remote_io_server.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

// Two programs that share nothing but wires: `rvbench devices` is the bench, `rvbench run` drives
// it. Real time: each test takes as long as its plan, and neither needs much of a processor.

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::Program;
using test::ScratchFolder;

// At the speed at which four output turns take the least, 16 s. Tests run beside others: a value
// may be older than on a bench with a computer of its own. The shaft of a bench that is gone is not
// seen to stop: then teardown waits for its whole time.
const std::string plan = R"({
  "name": "live",
  "specimen": {"kinematics": "rv20e", "gear_ratio": 121, "rated_output_torque_Nm": 167},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.9},
  "setup": [{"phase": "connect"},
            {"phase": "warm_up", "duration_s": 1, "speed_rpm": 1815, "load_pct": 50}],
  "main": [{"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [50, 100],
            "settling": {"hold_s": 0.5}, "record": {"output_turns": 4}}],
  "teardown": {"standstill_timeout_s": 8},
  "limits": [{"measure": "acceleration_peak", "unit": "g", "max": 1.0,
              "why": "the article saw about 0.1 g on good units and up to 2 g on a faulty one"}]
})";

// The bench: a process of its own, and somebody who types to it.
class Bench {
 public:
  explicit Bench(const ScratchFolder& folder, const std::string& options = "")
      : keys_(make_keyboard(folder)),
        program_(folder.path(),
                 {"/bin/sh", "-c",
                  "exec \"$0\" devices --rig sim --write-rig rig.json " + options + " < keys",
                  test::rvbench_path()}) {
    REQUIRE(program_.says("serving"));
  }
  ~Bench() { ::close(keys_); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void type(const std::string& line) {
    const std::string typed = line + "\n";
    REQUIRE(::write(keys_, typed.data(), typed.size()) == static_cast<ssize_t>(typed.size()));
    REQUIRE(program_.says(line + ": done"));
  }
  Program& program() { return program_; }

 private:
  static int make_keyboard(const ScratchFolder& folder) {
    const std::string path = (folder.path() / "keys").string();
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    return ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  }

  int keys_;
  Program program_;
};

std::vector<std::string> run_words() {
  return {test::rvbench_path(), "run", "plan.json", "--rig", "rig.json", "--serial", "X"};
}

nlohmann::json verdict_of(const ScratchFolder& folder) {
  std::filesystem::path newest;
  for (const auto& run : std::filesystem::directory_iterator(folder.path() / "runs" / "X")) {
    newest = std::max(newest, run.path());
  }
  return nlohmann::json::parse(bench::read_file(newest / "verdict.json").value_or("null"));
}

std::string reason_of(const ScratchFolder& folder) {
  return verdict_of(folder).at("reason").get<std::string>();
}

// The lines that a rig file names, held open: another bench is not given their names meanwhile.
class HeldLines {
 public:
  explicit HeldLines(const ScratchFolder& folder) {
    const auto values =
        nlohmann::json::parse(bench::read_file(folder / "rig.json").value_or("null")).flatten();
    for (const auto& value : values) {
      if (!value.is_string() || !value.get<std::string>().starts_with("/dev/pts/")) continue;
      files_.push_back(::open(value.get<std::string>().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
      REQUIRE(files_.back() >= 0);
    }
    REQUIRE_FALSE(files_.empty());
  }
  ~HeldLines() {
    for (const int file : files_) ::close(file);
  }
  HeldLines(const HeldLines&) = delete;
  HeldLines& operator=(const HeldLines&) = delete;

 private:
  std::vector<int> files_;
};

void await(Program& run, const std::string& text) {
  const bool is_said = run.says(text);
  INFO(run.said());
  REQUIRE(is_said);
}

}  // namespace

TEST_CASE("devices write a rig file that can be checked and probed", "[spec][devices]") {
  const ScratchFolder folder;
  Bench bench(folder);
  CHECK(test::rvbench(folder.path(), {"check", "rig.json"}).code == 0);
  const Answer probed = test::rvbench(folder.path(), {"probe", "--rig", "rig.json", "--json"});
  INFO(probed.err);
  CHECK(probed.code == 0);
  CHECK(nlohmann::json::parse(probed.out).at("watchdog").at("timeout_s") == 1);
  bench.program().send(SIGINT);
  CHECK(bench.program().wait().code == 0);
}

TEST_CASE("devices whose standard input is closed end when they are told to", "[spec][devices]") {
  const ScratchFolder folder;
  Program program(folder.path(),
                  {"/bin/sh", "-c", "exec " + test::rvbench_path() + " devices --rig sim <&-"});
  REQUIRE(program.says("Ctrl-C ends it"));
  program.send(SIGINT);
  CHECK(program.wait().code == 0);
}

TEST_CASE("devices that cannot be served are refused, with the reason", "[spec][devices]") {
  const ScratchFolder folder;
  bench::write_file(folder / "replay.json", R"({"rig": "replay", "recording": "r.h5"})");
  Answer answer = test::rvbench(folder.path(), {"devices", "--rig", "replay.json"});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("/rig: only the simulated bench can be served"));
  const sim::RemoteIoServer other;
  answer = test::rvbench(
      folder.path(), {"devices", "--rig", "sim", "--safety-port", std::to_string(other.port())});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("cannot listen on 127.0.0.1:" + std::to_string(other.port())));
}

TEST_CASE("a run on real wires passes a good unit, in real time", "[spec][devices]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder folder;
  bench::write_file(folder / "plan.json", plan);
  Bench bench(folder);
  const Answer answer = Program(folder.path(), run_words()).wait();
  INFO(answer.err);
  CHECK(answer.code == 0);
  const auto verdict = verdict_of(folder);
  CHECK(verdict.at("verdict") == "PASS");
  CHECK(verdict.at("points").size() == 2);
  for (const auto& point : verdict.at("points")) CHECK(point.at("status") == "ok");
  THEN("the bench ends when it is told to") {
    bench.program().send(SIGINT);
    CHECK(bench.program().wait().code == 0);
  }
}

TEST_CASE("a run on real wires finds the fault of a unit, its drive on a serial line",
          "[spec][devices]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder folder;
  std::string of_one_point = plan;
  of_one_point.replace(of_one_point.find("[50, 100]"), 9, "[100]");
  bench::write_file(folder / "plan.json", of_one_point);
  Bench bench(folder, "--preset input_shaft --drive-line");
  const Answer answer = Program(folder.path(), run_words()).wait();
  INFO(answer.err);
  CHECK(answer.code == 10);
  const auto verdict = verdict_of(folder);
  CHECK(verdict.at("verdict") == "FAIL");
  CHECK(verdict.at("findings").at(0).at("component") == "input_shaft");
}

TEST_CASE("a bench that hangs is missed before anything turns, within seconds", "[spec][devices]") {
  const ScratchFolder folder;
  bench::write_file(folder / "plan.json", plan);
  Bench bench(folder);
  bench.program().send(SIGSTOP);
  const auto start = std::chrono::steady_clock::now();
  const Answer answer = Program(folder.path(), run_words()).wait();
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(15));
  bench.program().send(SIGCONT);
  CHECK(answer.code == 30);
  CHECK_THAT(reason_of(folder), Contains("not every device answers: ") &&
                                    Contains("safety inputs") && Contains("CAN /dev/pts/") &&
                                    Contains("accelerometers") && Contains("inverter"));
}

TEST_CASE("a bench that is at work is left alone", "[spec][devices]") {
  const ScratchFolder folder;
  bench::write_file(folder / "plan.json", plan);
  Bench bench(folder);
  Program program(folder.path(), run_words());
  await(program, "warm up");
  const Answer second =
      test::rvbench(folder.path(), {"run", "plan.json", "--rig", "rig.json", "--serial", "Y"});
  CHECK(second.code == 2);
  CHECK_THAT(second.err, Contains("in use by another rvbench, process ") && Contains("/dev/pts/"));
  CHECK(test::rvbench(folder.path(), {"probe", "--rig", "rig.json"}).code == 2);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "runs" / "Y"));
  program.send(SIGINT);
  CHECK(program.wait().code == 50);  // it was not disturbed
  CHECK(test::rvbench(folder.path(), {"probe", "--rig", "rig.json"}).code == 0);
}

TEST_CASE("a bench that is gone in the middle of a run is missed at once", "[spec][devices]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder folder;
  bench::write_file(folder / "plan.json", plan);
  Bench bench(folder);
  Program program(folder.path(), run_words());
  await(program, "record 1815 rpm");
  const HeldLines held(folder);
  bench.program().send(SIGKILL);
  bench.program().wait();
  const Answer answer = program.wait();
  INFO(answer.err);
  CHECK(answer.code == 30);
  const auto verdict = verdict_of(folder);
  CHECK(verdict.at("verdict") == "ERROR");
  CHECK_THAT(reason_of(folder), Contains("silent for 0.9"));  // no later than the plan allows
}

TEST_CASE("an emergency stop ends a run on real wires", "[spec][devices][safety]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder folder;
  bench::write_file(folder / "plan.json", plan);
  Bench bench(folder);
  Program program(folder.path(), run_words());
  await(program, "record 1815 rpm");
  bench.type("estop");
  Answer answer = program.wait();
  INFO(answer.err);
  CHECK(answer.code == 40);
  const auto verdict = verdict_of(folder);
  CHECK_THAT(reason_of(folder), Contains("the emergency stop is pressed"));
  CHECK(verdict.at("run").at("shaft_stopped") == true);
  CHECK(verdict.at("run").at("brake_released") == true);
  WHEN("it is pressed still, nothing turns") {
    answer = Program(folder.path(), run_words()).wait();
    CHECK(answer.code == 40);
  }
  WHEN("it was released, a run that is lost its drive ends, too") {
    bench.type("heal");
    Program again(folder.path(), run_words());
    await(again, "warm up");
    bench.type("inverter silent");
    answer = again.wait();
    INFO(answer.err);
    CHECK(answer.code == 30);
    CHECK_THAT(reason_of(folder), Contains("drive silent for"));
  }
}

}  // namespace rvbench
