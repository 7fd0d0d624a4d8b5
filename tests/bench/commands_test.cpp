#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/find_plan.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/plan_files.hpp"
#include "bench/rig_factory.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

}  // namespace

TEST_CASE("every command explains itself with an example", "[bench]") {
  for (const char* command : {"run", "check", "judge", "report"}) {
    const CommandAnswer help = rvbench({command, "--help"});
    CHECK(help.code == 0);
    CHECK_THAT(help.out, Contains(std::string("rvbench ") + command + " "));
    CHECK_THAT(help.out, Contains("Examples:"));
  }
}

TEST_CASE("a dry run tells time, torque, power and points of the article's procedure", "[bench]") {
  const CommandAnswer answer =
      rvbench({"run", "rv20e_acceptance", "--rig", "sim", "--dry-run", "--json"});
  REQUIRE(answer.code == 0);
  const auto json = nlohmann::json::parse(answer.out);
  CHECK(json.at("points") == 63);
  CHECK(json.at("max_speed_rpm") == 1815);
  // 150 % of 167 N·m, over 121, at 1815 rpm = 190.07 rad/s
  CHECK(json.at("max_input_torque_Nm").get<double>() == Approx(1.5 * 167 / 121));
  CHECK(json.at("max_input_power_W").get<double>() ==
        Approx(1.5 * 167 / 121 * 190.066).epsilon(1e-4));
  CHECK(json.at("total_s").get<double>() > 600);
  CHECK_THAT(rvbench({"run", "quick", "--rig", "sim", "--dry-run"}).out, Contains("input W"));
}

TEST_CASE("a run without serial is a usage error, one without a plan a bad file", "[bench]") {
  CHECK(rvbench({"run", "quick", "--rig", "sim"}).code == 2);
  const CommandAnswer answer = rvbench({"run", "quikc", "--rig", "sim", "--serial", "A"});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("did you mean \"quick\"?"));
}

TEST_CASE("an interface of a name that none can have is a usage error", "[bench]") {
  const CommandAnswer answer = rvbench({"devices", "--rig", "sim", "--can", "averyverylongname0"});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("--can \"averyverylongname0\"") && Contains("15 characters"));
}

TEST_CASE("a rig file is written over no device and no folder", "[bench]") {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string();
  const CommandAnswer answer = rvbench({"devices", "--rig", "sim", "--write-rig", folder});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("--write-rig " + folder + " is no regular file"));
}

TEST_CASE("nothing to resume is a usage error", "[bench]") {
  const ScratchFolder scratch;
  const CommandAnswer answer = rvbench({"run", "quick", "--rig", "sim", "--serial", "A", "--resume",
                                        "--out", scratch.path().string()});
  CHECK(answer.code == 2);
  CHECK(std::filesystem::is_empty(scratch.path()));
}

TEST_CASE("a run that cannot begin leaves no folder that looks like one", "[bench]") {
  const ScratchFolder root;
  CHECK_THROWS(begin_run(root.path(), "A17", {{"no/such/folder", "{}"}}));
  CHECK(std::filesystem::is_empty(root.path() / "A17"));
}

TEST_CASE("a run is resumed on the rig that it began on, and on no other", "[bench]") {
  const ScratchFolder scratch;
  const auto folder = create_run_folder(scratch.path(), "A", "20260102T030405Z");
  write_file(folder / "plan.json", sequences::plan_to_json(std::get<0>(find_plan("quick"))));
  write_file(folder / "rig.json", rig_to_json("sim", {.preset = "healthy", .seed = 7}));
  const CommandAnswer answer = rvbench({"run", "quick", "--rig", "sim", "--seed", "8", "--serial",
                                        "A", "--resume", "--out", scratch.path().string()});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("rig.json says something else"));
}

TEST_CASE("a run is resumed on the machine that it began with, whatever its file says now",
          "[bench]") {
  const ScratchFolder scratch;
  const auto folder = create_run_folder(scratch.path(), "A", "20260102T030405Z");
  write_file(folder / "plan.json", sequences::plan_to_json(std::get<0>(find_plan("quick"))));
  write_file(folder / "rig.json", rig_to_json("sim", {}));
  write_file(folder / "kinematics.json", kinematics_text("cwru_6205"));
  const CommandAnswer answer = rvbench({"run", "quick", "--rig", "sim", "--serial", "A", "--resume",
                                        "--out", scratch.path().string()});
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("kinematics.json says something else"));
}

TEST_CASE("a run is resumed by what its files mean, not by how they are laid out", "[bench]") {
  const ScratchFolder root;
  const ResolvedFiles resolved{{"kinematics.json", R"({"machine": "m", "shafts": []})"},
                               {"plan.json", R"({"name": "p", "speeds_rpm": [605, 1210.0]})"}};
  const auto folder = begin_run(root.path(), "A17", resolved).folder;
  const auto resume = [&](const std::string& plan) {
    return resume_run(root.path(), "A17",
                      {{"kinematics.json", "{\n  \"shafts\": [],\n  \"machine\": \"m\"\n}\n"},
                       {"plan.json", plan}});
  };
  {
    const auto place = resume("{\"speeds_rpm\":[605.0,1210],\"name\":\"p\"}");
    REQUIRE(place.index() == 0);
    CHECK(std::get<0>(place).folder == folder);
  }
  for (const char* other : {R"({"name": "p", "speeds_rpm": [1210, 605]})",
                            R"({"name": "p", "speeds_rpm": [605, 1210], "repeats": 3})"}) {
    const auto place = resume(other);
    REQUIRE(place.index() == 1);
    CHECK_THAT(std::get<1>(place), Contains("plan.json says something else"));
  }
}

TEST_CASE("a report is rebuilt for the machine that was run, whatever its file says now",
          "[bench]") {
  const ScratchFolder run;
  const ScratchFolder plans;
  const std::string machine = (plans.path() / "mine.json").string();
  auto plan = std::get<0>(find_plan("quick"));
  plan.specimen.kinematics = machine;
  write_file(run.path() / "plan.json", sequences::plan_to_json(plan));
  write_file(run.path() / "kinematics.json", kinematics_text("rv20e"));
  write_file(run.path() / "verdict.json", judgement_to_json(test::passed_run()));
  write_sums(run.path());
  SECTION("it is gone") {}
  SECTION("it is another one") { write_file(machine, kinematics_text("cwru_6205")); }
  const CommandAnswer answer = rvbench({"report", run.path().string()});
  INFO(answer.err);
  CHECK(answer.code == 0);
  const std::string report = read_file(run.path() / "report.html").value_or("");
  CHECK_THAT(report, Contains("sun-planet mesh") && !Contains("motor shaft"));
}

TEST_CASE("a run that was cut short has no report, and is told so", "[bench]") {
  const ScratchFolder run;
  write_file(run.path() / "plan.json", sequences::plan_to_json(std::get<0>(find_plan("quick"))));
  const CommandAnswer answer = rvbench({"report", run.path().string()});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("has not come to its end: rvbench run --resume"));
}

TEST_CASE("check follows what a plan and a rig name", "[bench]") {
  const ScratchFolder scratch;
  const std::string plan = (scratch.path() / "plan.json").string();
  const std::string rig = (scratch.path() / "rig.json").string();
  auto quick = std::get<0>(find_plan("quick"));
  CHECK(quick.specimen.kinematics == "rv20e");
  quick.specimen.kinematics = "rv20";
  write_file(plan, sequences::plan_to_json(quick));
  write_file(rig, R"({"rig": "replay", "recording": "gone.h5"})");
  const CommandAnswer answer = rvbench({"check", plan, rig});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("/specimen/kinematics: rv20: cannot be read") &&
                             Contains("did you mean \"rv20e\"?"));
  CHECK_THAT(answer.err, Contains("rig.json:1: /recording: gone.h5: no such file"));
}

TEST_CASE("check prints the parts of a machine with their limits, and why", "[bench]") {
  const CommandAnswer answer = rvbench({"check", "rv20e"});
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains("rv20e: kinematics, no fault") && Contains("pin_housing") &&
                             Contains("0.04: assumed: pins of one class share the load alike"));
  CHECK_THAT(answer.out, Contains("0.1 (0.2 scattered): assumed: pitch errors"));
}

TEST_CASE("judge never guesses a rate or a speed", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = (scratch.path() / "bare.csv").string();
  std::string text = "a\n";
  for (int i = 0; i < 100; ++i) text += std::to_string(i % 7) + "\n";
  write_file(file, text);
  const CommandAnswer no_rate =
      rvbench({"judge", file, "--kinematics", "cwru_6205", "--speed", "1797"});
  CHECK(no_rate.code == 2);
  CHECK_THAT(no_rate.err, Contains(file + " states no sample rate: give it with --rate HZ"));
  const CommandAnswer no_speed =
      rvbench({"judge", file, "--kinematics", "cwru_6205", "--rate", "12000"});
  CHECK(no_speed.code == 2);
  CHECK_THAT(no_speed.err, Contains(file + " states no shaft speed: give it with --speed RPM"));
  CHECK(rvbench({"judge", file, "--kinematics", "cwru_6205", "--rate", "-1"}).code == 2);
}

TEST_CASE("judge refuses what is not there or no recording", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = (scratch.path() / "cut.mat").string();
  write_file(file, "MATLAB 5.0 MAT-file");
  CHECK(rvbench({"judge", file, "--kinematics", "cwru_6205"}).code == 20);
  CHECK(rvbench({"judge", file + "x", "--kinematics", "cwru_6205"}).code == 20);
  CHECK(rvbench({"judge", file, "--kinematics", "cwru"}).code == 3);
}

TEST_CASE("check names file, line and fault, of all files at once", "[bench]") {
  const ScratchFolder scratch;
  const std::string broken = (scratch.path() / "broken.json").string();
  const std::string plan = (scratch.path() / "plan.json").string();
  write_file(broken, "{\n  \"main\": [ 1, ]\n}");
  write_file(plan, "{ \"main\": [], \"nmae\": \"x\" }");
  const CommandAnswer answer = rvbench({"check", broken, plan, "nowhere.json"});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("broken.json:2:"));
  CHECK_THAT(answer.err, Contains("did you mean \"name\"?"));
  CHECK_THAT(answer.err, Contains("nowhere.json"));
  CHECK(answer.out.empty());
}

TEST_CASE("check and report refuse a run folder that was tampered with", "[bench]") {
  const ScratchFolder run;
  const std::string folder = run.path().string();
  const auto quick = std::ranges::find(plan_files(), "quick", &EmbeddedFile::name);
  write_file(run.path() / "plan.json", quick->text);
  write_file(run.path() / "verdict.json", judgement_to_json(test::passed_run()));
  CHECK(rvbench({"check", folder}).code == 3);
  write_sums(run.path());
  CHECK(rvbench({"check", folder}).code == 0);
  CHECK(rvbench({"report", folder}).code == 0);
  CHECK(rvbench({"check", folder}).code == 0);
  SECTION("a verdict that was made nicer") {
    write_file(run.path() / "verdict.json", judgement_to_json(test::failed_run()));
    const CommandAnswer tampered = rvbench({"check", folder});
    CHECK(tampered.code == 3);
    CHECK_THAT(tampered.err, Contains("verdict.json: does not match its hash"));
    CHECK(rvbench({"report", folder}).code == 3);
  }
  SECTION("a verdict that is none") {
    for (const char* text : {"", "{}", "[]", "{\"verdict\": 1}"}) {
      CAPTURE(text);
      write_file(run.path() / "verdict.json", text);
      CHECK(rvbench({"check", folder}).code == 3);
      const CommandAnswer report = rvbench({"report", folder});
      CHECK(report.code == 3);
      CHECK_THAT(report.err, Contains("verdict.json: is no verdict"));
    }
  }
  SECTION("a file more, a file less") {
    write_file(run.path() / "extra.txt", "x");
    std::filesystem::remove(run.path() / "report.html");
    const CommandAnswer answer = rvbench({"check", folder});
    CHECK(answer.code == 3);
    CHECK_THAT(answer.err,
               Contains("extra.txt: not listed in SHA256SUMS") && Contains("report.html: missing"));
  }
  SECTION("hashes that are none") {
    const std::string sums = read_file(run.path() / "SHA256SUMS").value();
    std::string elsewhere = sums;
    elsewhere.replace(sums.find("plan.json"), 9, "../../short.json");
    for (const std::string& text : {std::string("hello\n"), sums.substr(0, 40), elsewhere}) {
      write_file(run.path() / "SHA256SUMS", text);
      CHECK(rvbench({"check", folder}).code == 3);
    }
  }
}

}  // namespace rvbench::bench
