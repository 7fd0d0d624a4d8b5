#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/results/sqlite.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::Program;
using test::ScratchFolder;

constexpr const char* self_test_and_calibrations =
    R"("self_test": {"max_age_h": 24}, "calibration": {"channels": ["accel_1x", "input_torque"]})";

// A simulated station, and what it asks for.
class Station {
 public:
  explicit Station(const std::string& demands = self_test_and_calibrations) {
    bench::write_file(scratch_.path() / "rig.json",
                      R"({"rig": "sim", "qualification": {"station": "EOL 3", )" + demands + "}}");
    bench::write_file(scratch_.path() / "short.json", test::short_plan_with_limits());
  }

  Answer qualify(std::vector<std::string> words) {
    words.insert(words.begin(), "qualify");
    words.insert(words.end(), {"--rig", "rig.json"});
    return test::rvbench(scratch_.path(), words);
  }

  // The sensitivity that the simulated bench goes by: 100 mV/g.
  Answer calibrate(const std::string& channel, const std::string& until = "2099-12-31",
                   std::vector<std::string> more = {"--no-sensitivity"}) {
    std::vector<std::string> words{"calibrate",  "--channel", channel,    "--certificate",
                                   "K-4711",     "--by",      "J. Weber", "--on",
                                   "2020-01-01", "--until",   until};
    words.insert(words.end(), more.begin(), more.end());
    return qualify(words);
  }

  Answer run(const std::string& serial, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"run", "short.json", "--rig", "rig.json", "--serial", serial};
    words.insert(words.end(), more.begin(), more.end());
    return test::rvbench(scratch_.path(), words);
  }

  std::filesystem::path only_run(const std::string& serial) const {
    return std::filesystem::directory_iterator(runs() / serial)->path();
  }
  std::filesystem::path runs() const { return folder() / "runs"; }
  const std::filesystem::path& folder() const { return scratch_.path(); }

 private:
  ScratchFolder scratch_;
};

}  // namespace

TEST_CASE("a station that is not qualified turns nothing and says why, one that is lets pass",
          "[spec][station]") {
  Station station;
  CHECK(station.qualify({"status"}).code == 60);
  const Answer refused = station.run("A17", {"--json"});
  CHECK(refused.code == 60);
  const auto verdict = nlohmann::json::parse(refused.out);
  CHECK(verdict.at("verdict") == "ERROR");
  CHECK(verdict.at("error_kind") == "not_qualified");
  CHECK(verdict.at("exit_code") == 60);
  const auto folder = station.only_run("A17");
  for (const char* name : {"verdict.json", "junit.xml", "report.html", "log.jsonl"}) {
    CAPTURE(name);
    const std::string text = bench::read_file(folder / name).value_or("");
    CHECK((text.find("station EOL 3 has none") != std::string::npos));
    CHECK((text.find("calibration of input_torque") != std::string::npos));
  }
  CHECK_THAT(bench::read_file(folder / "log.jsonl").value_or(""), !Contains("armed"));
  CHECK_FALSE(std::filesystem::exists(folder / "recording.h5"));
  CHECK_THAT(station.run("A17", {"--dry-run"}).err, Contains("would end with exit 60"));

  const Answer tested = station.qualify({"--json"});
  INFO(tested.err);
  CHECK(tested.code == 0);
  const auto test = nlohmann::json::parse(tested.out);
  CHECK(test.at("passed") == true);
  CHECK(test.at("steps").size() == 5);
  CHECK_THAT(tested.err, Contains("tap on the housing now") &&
                             Contains("note: not qualified yet: calibration of accel_1x"));
  CHECK(station.calibrate("accel_1x", "2099-12-31", {"--sensitivity", "0.0102"}).code == 0);
  CHECK(station.calibrate("input_torque").code == 0);
  const Answer status = station.qualify({"status"});
  CHECK(status.code == 0);
  CHECK_THAT(status.out, Contains("self-test: passed") && Contains("valid until 2099-12-31") &&
                             Contains("The station is qualified."));
  const Answer passed = station.run("A18");
  INFO(passed.err);
  CHECK(passed.code == 0);
  // The one that was refused is gone on with, and report and re-judgement keep what was told.
  CHECK(test::rvbench(station.runs().parent_path(), {"report", folder.string()}).code == 0);
  CHECK_THAT(bench::read_file(folder / "report.html").value_or(""),
             Contains("station EOL 3 has none"));

  // The database is an index of what was shown.
  const auto database = bench::SqliteFile::open(station.runs() / "results.db", "results.db");
  REQUIRE(database);
  bench::SqlStatement count(database.value(),
                            "SELECT (SELECT count(*) FROM calibrations), (SELECT count(*) FROM "
                            "self_tests WHERE passed), (SELECT count(*) FROM self_test_readings)");
  REQUIRE(count.next());
  CHECK(count.integer(0) == 2);
  CHECK(count.integer(1) == 1);
  CHECK(count.integer(2) == 13 + 13 + 12 + 2 + 2);
}

TEST_CASE("an expired calibration, or another sensitivity, blocks with exit 60 and is named",
          "[spec][station]") {
  Station station;
  REQUIRE(station.qualify({}).code == 0);
  CHECK(station.calibrate("input_torque").code == 0);
  const Answer late = station.calibrate("accel_1x", "2021-01-01");
  CHECK(late.code == 0);
  CHECK_THAT(late.err, Contains("warning: calibration of accel_1x") && Contains("has expired"));
  const Answer refused = station.run("A17");
  CHECK(refused.code == 60);
  CHECK_THAT(refused.out, Contains("certificate K-4711 of 2020-01-01 has expired"));
  CHECK_FALSE(std::filesystem::exists(station.only_run("A17") / "recording.h5"));
  CHECK(station.calibrate("accel_1x", "2099-12-31", {"--sensitivity", "0.0110"}).code == 0);
  CHECK_THAT(station.run("A18").out, Contains("the rig goes by 0.0102, -7.3 % off"));
  CHECK_THAT(station.qualify({"records"}).out,
             Contains("accel_1x") && Contains("valid until 2021-01-01") && Contains("J. Weber") &&
                 Contains("no sensitivity") && Contains("0.011 V per unit"));
  // Left out, nothing would be held against the rig's any more.
  CHECK_THAT(station.calibrate("accel_1x", "2099-12-31", {}).err,
             Contains("give --sensitivity, or --no-sensitivity"));
  CHECK(station.qualify({"status"}).code == 60);
}

TEST_CASE("calibrations that make no sense are refused, and nothing is kept", "[spec][station]") {
  Station station;
  CHECK_THAT(station.calibrate("accel_9x").err, Contains("no channel \"accel_9x\""));
  CHECK_THAT(station.calibrate("accel_1x", "2019-01-01").err, Contains("lies before"));
  CHECK_THAT(station.calibrate("accel_1x", "next year").err, Contains("are days"));
  CHECK_THAT(station.calibrate("accel_1x", "2099-12-31", {"--sensitivity", "-1"}).err,
             Contains("above 0"));
  CHECK_THAT(station.qualify({"calibrate", "--channel", "accel_1x", "--certificate", " "}).err,
             Contains("--certificate"));
  CHECK_THAT(station.qualify({"calibrate", "--channel", "accel_1x", "--certificate", "K 1 "}).err,
             Contains("no blank may begin or end it"));
  CHECK_THAT(
      station
          .qualify({"calibrate", "--channel", "accel_1x", "--certificate", std::string(1000, 'x')})
          .err,
      Contains("--certificate is too long"));
  CHECK_FALSE(std::filesystem::exists(station.runs()));
}

TEST_CASE("a self-test without its tap does not qualify, and is on record", "[spec][station]") {
  Station station;
  const Answer answer = station.qualify({"--no-tap"});
  CHECK(answer.code == 60);
  CHECK_THAT(answer.out, Contains("skipped") && Contains("nobody was there to tap"));
  CHECK_THAT(station.qualify({"status"}).out, Contains("failed") && Contains("was not passed"));
}

TEST_CASE("a self-test that is killed was not passed, one that is stopped says nothing",
          "[spec][station]") {
  Station station(R"("self_test": {"max_age_h": 24, "rest_s": 60})");
  const auto end_one_by = [&](int signal) {
    Program program(station.folder(), {test::rvbench_path(), "qualify", "--rig", "rig.json"});
    REQUIRE(program.says("listen to the sensors at rest"));
    CHECK(program.send(signal));
    return program.wait().code;
  };
  REQUIRE(station.qualify({}).code == 0);
  CHECK(end_one_by(SIGINT) == 50);
  CHECK(station.qualify({"status"}).code == 0);
  CHECK(end_one_by(SIGKILL) == -SIGKILL);
  const Answer status = station.qualify({"status"});
  CHECK(status.code == 60);
  CHECK_THAT(status.out, Contains("has not come to its end: if none is at work, repeat it"));
  REQUIRE(station.qualify({}).code == 0);
  CHECK(station.qualify({"status"}).code == 0);
}

TEST_CASE("of a rig that asks for nothing nothing is asked", "[spec][station]") {
  const ScratchFolder scratch;
  const Answer status = test::rvbench(scratch.path(), {"qualify", "status", "--rig", "sim"});
  CHECK(status.code == 0);
  CHECK_THAT(status.out, Contains("Nothing is asked of this station"));
  const Answer untested = test::rvbench(scratch.path(), {"qualify", "--rig", "sim"});
  CHECK(untested.code == 3);
  CHECK_THAT(untested.err, Contains("/qualification: this section is missing"));
}

TEST_CASE("once the golden unit is in control others can pass, until it moves", "[spec][station]") {
  if (test::too_long_under_sanitizer()) return;
  Station station(R"("golden_unit": {"serial": "G01", "plan": "short", "baseline_runs": 8})");
  const auto run_as = [&](const std::string& serial, int seed, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--seed", std::to_string(seed)});
    return station.run(serial, more);
  };
  CHECK_THAT(run_as("A17", 100).out, Contains("golden unit G01: it has no run of plan short"));
  CHECK_THAT(run_as("g01", 1).err, Contains("\"g01\" differs from the golden unit's only in"));
  for (int seed = 1; seed <= 8; ++seed) CHECK(run_as("G01", seed).code == 0);
  CHECK(run_as("A17", 100).code == 60);  // a chart of eight has no run that it could judge
  CHECK(run_as("G01", 9).code == 0);
  const Answer status = station.qualify({"status"});
  INFO(status.out);
  CHECK(status.code == 0);
  CHECK(run_as("A18", 100).code == 0);

  // Its input shaft is not what it was: the golden unit fails, and nobody else can pass.
  const Answer bent = run_as("G01", 11, {"--preset", "input_shaft"});
  CHECK(bent.code == 10);
  CHECK_THAT(bent.out, Contains("input_shaft"));
  const Answer refused = run_as("A19", 100);
  CHECK(refused.code == 60);
  CHECK_THAT(refused.out, Contains("golden unit G01"));

  // Nor is that forgotten with all that tells of it but the ledger.
  const auto failed =
      std::ranges::max(bench::folders_in(station.runs() / "G01"), {},
                       [](const auto& run) { return bench::read_run_begin(run).number; });
  std::filesystem::remove_all(failed);
  std::filesystem::remove(station.runs() / "results.db");
  CHECK_THAT(run_as("A20", 100).out,
             Contains(failed.filename().string() + "/verdict.json is missing"));
}

TEST_CASE("a run that is refused connects and turns nothing", "[spec][station][safety]") {
  test::BenchRun run;
  run.refuse({Outcome::error, ErrorKind::not_qualified, "the station is not qualified: a, b"});
  run.go();
  CHECK(exit_code(run.judgement().ending) == 60);
  test::check_told(run, "ERROR", "the station is not qualified: a, b");
  CHECK(run.world().now_s() == 0);
  CHECK_FALSE(run.world().inverter().output_enabled());
  CHECK(std::isnan(run.told_s("armed")));
}

}  // namespace rvbench
