#include <signal.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/terminal.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::Program;
using test::ScratchFolder;

std::filesystem::path only_run(const std::filesystem::path& runs) {
  const std::filesystem::directory_iterator found(runs);
  REQUIRE(found != std::filesystem::directory_iterator());
  return found->path();
}

nlohmann::json verdict_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(bench::read_file(folder / "verdict.json").value_or("null"));
}

std::string verdict_in_history(const ScratchFolder& scratch) {
  const Answer history = test::rvbench(scratch.path(), {"history", "--json"});
  return nlohmann::json::parse(history.out).at("runs").at(0).at("verdict");
}

// The rig's time is real, so that another thread writes the log. It measures for half a minute.
std::vector<std::string> run_of_replay(const ScratchFolder& scratch) {
  bench::write_file(scratch / "short.json", test::short_plan);
  (void)test::rvbench(scratch.path(),
                      {"run", "short.json", "--rig", "sim", "--serial", "B", "--out", "recorded"});
  const auto recording = only_run(scratch / "recorded" / "B") / "recording.h5";
  const nlohmann::json rig{
      {"rig", "replay"}, {"recording", recording.string()}, {"pace", "real_time"}};
  bench::write_file(scratch / "replay.json", rig.dump());
  return {test::rvbench_path(), "run", "short.json", "--rig", "replay.json", "--serial", "A17"};
}

}  // namespace

TEST_CASE("a run goes to its end when its terminal has been stopped", "[spec][safety]") {
  const ScratchFolder scratch;
  const test::Terminal terminal;
  bench::write_file(scratch / "short.json", test::unsettled_plan());
  terminal.stop();
  Program program(
      scratch.path(),
      {"/bin/sh", "-c",
       "TERM=xterm exec \"$0\" run short.json --rig sim --serial A17 2> " + terminal.name(),
       test::rvbench_path()});
  const Answer answer = program.wait();
  CHECK(answer.code == 20);
  CHECK_THAT(answer.out, Contains("INVALID"));
  CHECK(verdict_of(only_run(scratch / "runs" / "A17")).at("verdict") == "INVALID");
  CHECK(verdict_in_history(scratch) == "INVALID");
}

TEST_CASE("a run whose log takes nothing any more ends with its verdict", "[spec][safety]") {
  const ScratchFolder scratch;
  std::vector<std::string> words = run_of_replay(scratch);
  {
    Program killed(scratch.path(), words);
    REQUIRE(killed.says("warm up at"));
    killed.send(SIGKILL);
    killed.wait();
  }
  const auto folder = only_run(scratch / "runs" / "A17");
  std::filesystem::remove(folder / "log.jsonl");
  std::filesystem::remove(folder / "recording.h5");
  const test::Terminal log;  // it may be opened, and read, and hangs whoever writes
  log.give_nothing();
  log.stop();
  std::filesystem::create_symlink(log.name(), folder / "log.jsonl");
  words.emplace_back("--resume");
  Program resumed(scratch.path(), words);
  REQUIRE(resumed.says("warm up at"));
  resumed.send(SIGINT);
  const Answer answer = resumed.wait();
  INFO(answer.err);
  CHECK(answer.code == 50);
  CHECK_THAT(answer.out, Contains("ABORTED"));
  const nlohmann::json verdict = verdict_of(folder);
  CHECK(verdict.at("verdict") == "ABORTED");
  CHECK(verdict.at("run").at("shaft_stopped") == true);
  CHECK(verdict.at("run").at("events").empty());  // which are with the thread that hangs
  CHECK(bench::verify_sums(folder) == std::vector<std::string>{"log.jsonl: not a file of the run"});
  CHECK(verdict_in_history(scratch) == "ABORTED");
}

}  // namespace rvbench
