#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/file_lock.hpp"
#include "bench/find_plan.hpp"
#include "bench/rig_factory.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

TEST_CASE("with --json every refusal is one document on standard output", "[bench]") {
  struct Case {
    std::vector<std::string> words;
    int code;
    const char* reason;
  };
  const std::vector<Case> cases{
      {{"runn", "quick"}, 2, "unknown command"},
      {{"jugde"}, 2, "did you mean \"judge\"?"},
      {{"run"}, 2, "PLAN is required"},
      {{"run", "quick"}, 2, "--rig is required"},
      {{"run", "quick", "--rig", "sim"}, 2, "--serial is required"},
      {{"run", "quick", "--rig", "sim", "--serial", ""}, 2, "--serial: must not be empty"},
      {{"run", "quick", "--rgi", "sim"}, 2, "unknown option --rgi, did you mean \"--rig\"?"},
      {{"run", "quick", "--rig", "sim", "--serial", "A", "--seed", "18446744073709551615"},
       2,
       "--seed: must be a whole number from 0 to 9007199254740991"},
      {{"run", "quick", "--rig", "sim", "--serial", "A", "--seed", "99999999999999999999"},
       2,
       "--seed: must be a whole number from 0 to 9007199254740991"},
      {{"run", "quick", "--rig", "sim", "--serial", "A", "--seed", "-1"},
       2,
       "must be a whole number from 0"},
      {{"run", "quick", "--rig", "sim", "--serial", "A", "--seed", "x"}, 2, "--seed"},
      {{"judge", "a.csv", "--kinematics", "rv20e", "--speed", "fast"}, 2, "--speed"},
      {{"run", "quick", "more", "--rig", "sim", "--serial", "A"}, 2, "more"},
      {{"judge", "a.csv"}, 2, "--kinematics is required"},
      {{"judge", "a.csv", "--kinematics", "rv20e", "--out", ""}, 2, "--out: must not be empty"},
      {{"judge", "a.csv", "--kinematics", "rv20e", "--catalogue", "publishd"}, 2, "--catalogue"},
      {{"run", "quikc", "--rig", "sim", "--serial", "A"}, 3, "did you mean \"quick\"?"},
      {{"run", "quick", "--rig", "nowhere.json", "--serial", "A"}, 3, "nowhere.json"},
      {{"judge", "a.csv", "--kinematics", "rv20e", "--rate", "0"},
       2,
       "--rate must be 0.001 to 1e+08 Hz"},
      {{"judge", "a.csv", "--kinematics", "rv20"}, 3, "did you mean \"rv20e\"?"},
      {{"judge", "nowhere.csv", "--kinematics", "rv20e"}, 20, "no such file"}};
  for (const Case& refused : cases) {
    CAPTURE(refused.reason);
    std::vector<std::string> words = refused.words;
    words.emplace_back("--json");
    const CommandAnswer answer = rvbench(words);
    CHECK(answer.code == refused.code);
    const auto json = nlohmann::json::parse(answer.out);
    CHECK(json.at("exit_code") == refused.code);
    CHECK_THAT(json.at("reason").get<std::string>(), Contains(refused.reason));
    CHECK(json.at("verdict") ==
          (refused.code == 20 ? nlohmann::json("INVALID") : nlohmann::json(nullptr)));
    CHECK_THAT(answer.err, Contains(refused.reason));
    CHECK(rvbench(refused.words).out.empty());  // without --json nothing is printed there
  }
}

TEST_CASE("a command without what it is about asks for that", "[bench]") {
  for (const auto& [command, told] :
       {std::pair{"check", "FILE is required"}, {"report", "RUN is required"}}) {
    const CommandAnswer answer = rvbench({command});
    CHECK(answer.code == 2);
    CHECK(answer.out.empty());
    CHECK_THAT(answer.err, Contains(told));
  }
}

TEST_CASE("a name that does not exist is answered with those that do", "[bench]") {
  const auto told = [](const std::vector<std::string>& words) {
    const CommandAnswer answer = rvbench(words);
    CHECK(answer.code == 3);
    return answer.err;
  };
  CHECK_THAT(told({"run", "quikc", "--rig", "sim", "--serial", "A"}),
             Contains("there are: quick, rv20e_acceptance") && Contains("did you mean \"quick\"?"));
  CHECK_THAT(told({"run", "quick", "--rig", "simm", "--serial", "A"}),
             Contains("there are: sim") && Contains("did you mean \"sim\"?"));
  CHECK_THAT(told({"run", "quick", "--rig", "sim", "--serial", "A", "--preset", "helthy"}),
             Contains("crank_bearing") && Contains("did you mean \"healthy\"?"));
  CHECK_THAT(
      told({"judge", "a.csv", "--kinematics", "two_stag"}),
      Contains("cwru_6205, gear0, rv20e, two_stage") && Contains("did you mean \"two_stage\"?"));
}

TEST_CASE("every line of a refusal says who speaks", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  const std::string machine = (scratch.path() / "m.json").string();
  write_file(machine, R"({"machine": "m", "shafts": [{"nam": "in"}]})");
  for (const std::string& named : {std::string("nosuch"), machine}) {
    const CommandAnswer answer = rvbench({"judge", "a.csv", "--kinematics", named});
    CHECK(answer.code == 3);
    std::istringstream lines(answer.err);
    for (std::string line; std::getline(lines, line);) CHECK(line.starts_with("rvbench: "));
  }
}

TEST_CASE("a rig file with a preset that does not exist is a bad file", "[bench]") {
  const ScratchFolder scratch;
  const std::string rig = (scratch.path() / "rig.json").string();
  write_file(rig, "{\"rig\": \"sim\",\n \"preset\": \"helthy\"}");
  const CommandAnswer answer = rvbench({"check", rig});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("rig.json:2: /preset") && Contains("did you mean \"healthy\"?"));
}

TEST_CASE("a file of another kind is told what it seems to be", "[bench]") {
  const ScratchFolder scratch;
  const std::string plan = (scratch.path() / "plan.json").string();
  const std::string rig = (scratch.path() / "rig.json").string();
  write_file(plan, sequences::plan_to_json(std::get<0>(find_plan("quick"))));
  write_file(rig, rig_to_json("sim", {}));
  CHECK_THAT(rvbench({"run", plan, "--rig", plan, "--serial", "A"}).err,
             Contains("seems to be a plan file, not a rig file"));
  CHECK_THAT(rvbench({"run", rig, "--rig", "sim", "--serial", "A"}).err,
             Contains("seems to be a rig file, not a plan file"));
  CHECK_THAT(rvbench({"judge", "a.csv", "--kinematics", rig}).err,
             Contains("seems to be a rig file, not a kinematics file"));
}

TEST_CASE("check refuses what is no regular file, and does not wait for it", "[bench]") {
  const ScratchFolder scratch;
  const std::string pipe = (scratch.path() / "pipe").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const CommandAnswer answer = rvbench({"check", pipe, scratch.path().string()});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("pipe: cannot be read: it is no regular file"));
  CHECK_THAT(answer.err, Contains("no run folder"));
}

TEST_CASE("help shows what there is, and each default", "[bench]") {
  const CommandAnswer run = rvbench({"run", "--help"});
  CHECK_THAT(run.out, Contains("quick, rv20e_acceptance") && Contains("planet_tooth") &&
                          Contains("default: runs") && Contains("healthy"));
  const CommandAnswer judge = rvbench({"judge", "--help"});
  CHECK_THAT(judge.out, Contains("two_stage") && Contains("default: derived"));
  for (const std::string& help : {run.out, judge.out}) {
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
  }
}

TEST_CASE("a run that another process is at work on is not resumed", "[bench]") {
  const ScratchFolder scratch;
  const auto folder = create_run_folder(scratch.path(), "A", "20260102T030405Z");
  write_file(folder / "plan.json", sequences::plan_to_json(std::get<0>(find_plan("quick"))));
  write_file(folder / "rig.json", "{}");
  const std::vector<std::string> resume{"run",      "quick", "--rig", "sim",
                                        "--serial", "A",     "--out", scratch.path().string(),
                                        "--resume"};
  {
    const auto lock = FileLock::take(folder / "log.jsonl");
    REQUIRE(lock);
    CHECK_FALSE(FileLock::take(folder / "log.jsonl"));
    const CommandAnswer answer = rvbench(resume);
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("another rvbench is at work in"));
    for (const char* command : {"check", "report"}) {
      const CommandAnswer early = rvbench({command, folder.string()});
      CHECK(early.code == 3);
      CHECK_THAT(early.err, Contains("still at work in it"));
    }
  }
  CHECK_THAT(rvbench({"check", folder.string()}).err, Contains("the run did not finish"));
  CHECK_THAT(rvbench(resume).err, Contains("rig.json says something else"));  // the lock is free
}

TEST_CASE("a run that has lost its plan is no run that is not there", "[bench]") {
  const ScratchFolder scratch;
  const auto folder = create_run_folder(scratch.path(), "A", "20260102T030405Z");
  write_file(folder / "recording.h5", "");
  const CommandAnswer answer = rvbench({"run", "quick", "--rig", "sim", "--serial", "A", "--out",
                                        scratch.path().string(), "--resume"});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("is damaged: nobody knows what the run was"));
}

TEST_CASE("a simulated rig that does not say that it is one is still a rig", "[bench]") {
  const ScratchFolder scratch;
  write_file(scratch.path() / "rig.json", R"({"preset": "healthy", "plant": "rv20e_bench"})");
  CHECK(rvbench({"check", (scratch.path() / "rig.json").string()}).code == 0);
}

TEST_CASE("a report that cannot be written is refused, not an internal error", "[bench]") {
  const ScratchFolder run;
  write_file(run.path() / "plan.json", sequences::plan_to_json(std::get<0>(find_plan("quick"))));
  write_file(run.path() / "verdict.json", judgement_to_json(test::passed_run()));
  write_file(run.path() / "report.html", "");
  write_sums(run.path());
  const test::FileSizeLimit no_room(0);
  const CommandAnswer answer = rvbench({"report", run.path().string()});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("report: cannot be written") && Contains("File too large"));
}

TEST_CASE("an option whose value is empty takes no other option for it", "[bench][safety]") {
  const ScratchFolder scratch;
  const std::string runs = (scratch.path() / "runs").string();
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--serial=", "--dry-run"}, {"--serial", "", "--dry-run"}}) {
    std::vector<std::string> words{"run", "quick", "--rig", "sim", "--out", runs};
    words.insert(words.end(), more.begin(), more.end());
    const CommandAnswer answer = rvbench(words);
    CHECK(answer.code == 2);
    CHECK_FALSE(std::filesystem::exists(runs));
  }
  const CommandAnswer blank =
      rvbench({"run", "quick", "--rig", "sim", "--out", runs, "--serial", "A1 "});
  CHECK(blank.code == 2);
  CHECK_THAT(blank.err, Contains("no blank may begin or end it"));
  const CommandAnswer no_text =
      rvbench({"run", "quick", "--rig", "sim", "--out", runs, "--serial", "A\xff"});
  CHECK(no_text.code == 2);
  CHECK_THAT(no_text.err, Contains("is not UTF-8"));
}

TEST_CASE("a unit is simulated on the simulated bench only", "[bench]") {
  const ScratchFolder scratch;
  const std::string rig = (scratch.path() / "rig.json").string();
  write_file(rig, R"({"rig": "replay", "recording": "none.h5"})");
  const CommandAnswer answer =
      rvbench({"run", "quick", "--rig", rig, "--serial", "A", "--seed", "3"});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("--seed") && Contains("none is simulated"));
}

TEST_CASE("devices write over a rig file and over no other", "[bench]") {
  const ScratchFolder scratch;
  const std::string mine = (scratch.path() / "mine.txt").string();
  write_file(mine, "dear diary");
  const CommandAnswer answer = rvbench({"devices", "--rig", "sim", "--write-rig", mine});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("it would be lost"));
  CHECK(read_file(mine) == "dear diary");
}

}  // namespace rvbench::bench
