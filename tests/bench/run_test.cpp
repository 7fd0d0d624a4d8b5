#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/cli.hpp"
#include "bench/plan_files.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::bench {

using test::CommandAnswer;

namespace {

// The built-in quick plan, with one point and the shortest record that a diagnosis can use.
std::string one_point_plan() {
  const auto quick = std::ranges::find(plan_files(), "quick", &EmbeddedFile::name);
  auto plan = nlohmann::ordered_json::parse(quick->text);
  plan["main"][0]["speeds_rpm"] = {1815};
  plan["main"][0]["loads_pct"] = {100};
  return plan.dump(2);
}

}  // namespace

TEST_CASE("a run leaves a folder that says everything and agrees with its exit code", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch.path() / "one.json", one_point_plan());
  std::ostringstream out;
  std::ostringstream err;
  Console console{out, err};
  const std::string runs = (scratch.path() / "runs").string();
  const int code =
      run_cli({"run", (scratch.path() / "one.json").string(), "--rig", "sim", "--serial", "A17",
               "--preset", "input_shaft", "--seed", "3", "--out", runs, "--json"},
              make_commands(), console);
  INFO(err.str());
  const auto printed = nlohmann::json::parse(out.str());
  CHECK(printed.at("exit_code") == code);
  CHECK(printed.at("seed") == 3);
  CHECK(printed.at("points").size() == 1);
  CHECK(printed.at("points").at(0).at("status") == "ok");
  CHECK(printed.at("run").at("shaft_stopped") == true);

  const std::filesystem::path folder =
      std::filesystem::directory_iterator(scratch.path() / "runs" / "A17")->path();
  for (const char* name : {"plan.json", "rig.json", "kinematics.json", "recording.h5",
                           "verdict.json", "junit.xml", "report.html", "log.jsonl", "SHA256SUMS"}) {
    INFO(name);
    CHECK(std::filesystem::file_size(folder / name) > 0);
  }
  CHECK(verify_sums(folder).empty());
  CHECK(read_file(folder / "verdict.json") == out.str());
  CHECK_FALSE(newest_unfinished_run(runs, "A17"));
  const CommandAnswer history = test::rvbench({"history", "--out", runs, "--json"});
  CHECK(nlohmann::json::parse(history.out).at("runs").at(0).at("verdict") == printed.at("verdict"));

  // A speed that the user states goes before the angle that was measured.
  const CommandAnswer judged =
      test::rvbench({"judge", (folder / "recording.h5").string(), "--kinematics", "rv20e",
                     "--channel", "accel_1x", "--speed", "1500"});
  CHECK(judged.code == 20);
  CHECK_THAT(judged.err, Catch::Contains("speed 1500 rpm as given: the shaft's angle, which says"));
}

TEST_CASE("a run without report is whole, and the report is made later", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch.path() / "one.json", one_point_plan());
  const std::string runs = (scratch.path() / "runs").string();
  const CommandAnswer answer =
      test::rvbench({"run", (scratch.path() / "one.json").string(), "--rig", "sim", "--serial",
                     "A17", "--out", runs, "--no-report"});
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Catch::Contains("PASS") && !Catch::Contains("Report:"));
  const std::filesystem::path folder =
      std::filesystem::directory_iterator(scratch.path() / "runs" / "A17")->path();
  CHECK_FALSE(std::filesystem::exists(folder / "report.html"));
  CHECK(verify_sums(folder).empty());
  CHECK(test::rvbench({"report", folder.string()}).code == 0);
  CHECK(std::filesystem::file_size(folder / "report.html") > 0);
  CHECK(verify_sums(folder).empty());
}

TEST_CASE("a brief ending has the verdict first and the limits that are nearest to it", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch.path() / "one.json", one_point_plan());
  const CommandAnswer answer = test::rvbench(
      {"run", (scratch.path() / "one.json").string(), "--rig", "sim", "--serial", "A17", "--preset",
       "input_shaft", "--seed", "3", "--out", (scratch.path() / "runs").string(), "--brief"});
  CHECK(answer.code == 10);
  CHECK(answer.out.starts_with("FAIL  "));
  CHECK(std::ranges::count(answer.out, '\n') <= 6);
  // The part that made it fail exceeds its limit most.
  const std::size_t nearest = answer.out.find(" %  ");
  REQUIRE(nearest != std::string::npos);
  CHECK(answer.out.substr(nearest + 4).starts_with("input_shaft: "));
  CHECK(std::stod(answer.out.substr(answer.out.rfind('\n', nearest))) > 100);
  CHECK_THAT(answer.out, Catch::Contains("Report: ") && !Catch::Contains("kinematics explains"));
}

TEST_CASE("a run whose points are all measured is resumed by judging them", "[bench]") {
  if (test::too_long_under_sanitizer()) return;
  const rvbench::test::ScratchFolder scratch;
  const std::string plan = (scratch.path() / "one.json").string();
  write_file(plan, one_point_plan());
  const std::string runs = (scratch.path() / "runs").string();
  const auto run = [&](std::vector<std::string> more) {
    std::ostringstream out;
    std::ostringstream err;
    Console console{out, err};
    more.insert(more.begin(),
                {"run", plan, "--rig", "sim", "--serial", "A17", "--out", runs, "--json"});
    const int code = run_cli(more, make_commands(), console);
    INFO(err.str());
    CHECK(nlohmann::json::parse(out.str()).at("exit_code") == code);
    return code;
  };
  const int code = run({});
  const std::filesystem::path folder =
      std::filesystem::directory_iterator(scratch.path() / "runs" / "A17")->path();
  const std::string verdict = read_file(folder / "verdict.json").value();
  std::filesystem::remove(folder / "verdict.json");  // as if it had been killed while judging

  CHECK(run({"--resume"}) == code);
  CHECK_FALSE(std::filesystem::exists(folder / "recording-2.h5"));
  const std::string log = read_file(folder / "log.jsonl").value();
  CHECK_THAT(log, Catch::Contains("nothing is turned"));
  CHECK(log.find("phase warm_up") == log.rfind("phase warm_up"));  // once
  const auto before = nlohmann::json::parse(verdict);
  const auto after = nlohmann::json::parse(read_file(folder / "verdict.json").value());
  CHECK(after.at("points") == before.at("points"));
  CHECK(after.at("verdict") == before.at("verdict"));
  CHECK(after.at("run").at("shaft_stopped") == true);
  CHECK(after.at("run").at("started_utc") == before.at("run").at("started_utc"));
  CHECK(verify_sums(folder).empty());

  SECTION("points that are no longer in a recording are measured again, and it is said") {
    std::filesystem::remove(folder / "verdict.json");
    std::filesystem::remove(folder / "recording.h5");
    CHECK(run({"--resume"}) == code);
    const auto again = nlohmann::json::parse(read_file(folder / "verdict.json").value());
    const std::string quality = again.at("quality").dump();
    CHECK_THAT(quality,
               Catch::Contains("no longer in the run's recordings") && Catch::Contains("points 0"));
    CHECK_THAT(read_file(folder / "log.jsonl").value(),
               Catch::Contains("warning: measured before"));
  }
  SECTION("unless its bench was not seen at rest: then the last point is measured again") {
    std::filesystem::remove(folder / "verdict.json");
    const std::string good_end = "shaft at standstill, brake released";
    REQUIRE(log.find(good_end) != std::string::npos);
    std::string bad_end = log;
    bad_end.replace(bad_end.find(good_end), good_end.size(),
                    "shaft not seen at standstill, brake released");
    write_file(folder / "log.jsonl", bad_end);
    CHECK(run({"--resume"}) == code);
    CHECK(std::filesystem::exists(folder / "recording-2.h5"));
    const auto again = nlohmann::json::parse(read_file(folder / "verdict.json").value());
    CHECK(again.at("run").at("shaft_stopped") == true);
    CHECK(again.at("run").at("resumed_at_point") == 0);
    CHECK(verify_sums(folder).empty());
  }
}

}  // namespace rvbench::bench
