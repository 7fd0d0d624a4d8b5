#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <vector>

#include "bench/text_file.hpp"
#include "tests/hal/mat5_builder.hpp"
#include "tests/hal/recording_fixture.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::replaced;
using test::ScratchFolder;

struct BadFile {
  const char* name;
  std::string text;
  std::vector<std::string> told;  // what begins with ":" comes after the file's name
};

// No crash: neither a signal nor a sanitizer's report.
void check_civil(const Answer& answer) {
  CHECK(answer.code >= 0);
  CHECK_THAT(answer.err, !Contains("Sanitizer") && !Contains("runtime error"));
  CHECK_THAT(answer.err, !Contains("internal error"));
}

void check_refused(const BadFile& bad, const std::vector<std::string>& arguments) {
  DYNAMIC_SECTION(bad.name) {
    const ScratchFolder scratch;
    std::ofstream(scratch.path() / "bad.json", std::ios::binary) << bad.text;
    const Answer answer = test::rvbench(scratch.path(), arguments);
    check_civil(answer);
    CHECK(answer.code == 3);
    CHECK(answer.out.empty());
    for (const std::string& told : bad.told) {
      CHECK_THAT(answer.err, Contains((told.starts_with(':') ? "bad.json" : "") + told));
    }
  }
}

// Faults of any JSON file, whatever it is about. Line 1 is that of `key`.
std::vector<BadFile> broken_json(const std::string& key) {
  const std::string start = "{\"" + key + "\": ";
  return {{"empty", "", {":1: "}},
          {"blank", "\n\n", {":1: "}},
          {"cut off", start + "[", {":1: "}},
          {"not UTF-8", start + "\"\xFF\xFE\"}", {":1: syntax error"}},
          {"NaN", start + "\nNaN}", {":2: syntax error", ":2: syntax error"}},
          {"1e999", start + "\n\n1e999}", {":3: number overflow parsing '1e999'"}},
          {"duplicate key", start + "1,\n\"" + key + "\": 2}", {":2: /" + key + ": duplicate key"}},
          {"deep", start + std::string(100000, '['), {":1: nested deeper than 64 levels"}},
          {"deep objects",
           std::string(5000, ' ') +
               [] {
                 std::string text;
                 for (int i = 0; i < 5000; ++i) text += "{\"a\":";
                 return text;
               }(),
           {":1: nested deeper than 64 levels"}},
          {"list", "[]", {":1: expected an object, found an array"}},
          {"number", "3", {":1: expected an object, found 3"}},
          {"huge", start + "\"" + std::string(5'000'000, 'x') + "\"}", {": larger than 4 MiB"}},
          {"zero bytes", std::string(100, '\0'), {":1: syntax error"}}};
}

std::string with(const std::string& from, const std::string& to) {
  return replaced(test::short_plan, from, to);
}

const std::string gears = R"({"machine": "m", "shafts": [{"name": "in"}, {"name": "out"}],
"meshes": [{"name": "pair", "driver": "in", "driver_teeth": 20, "driven": "out",
            "driven_teeth": 60}],
"bearings": [{"name": "front", "shaft": "in", "rolling_elements": 9, "ball_diameter_mm": 8,
              "pitch_diameter_mm": 40}]})";

}  // namespace

TEST_CASE("broken JSON is refused with file and line, whatever it is for", "[spec][bad_files]") {
  for (const BadFile& bad : broken_json("main")) {
    check_refused(bad, {"run", "bad.json", "--rig", "sim", "--serial", "A"});
  }
}

TEST_CASE("check refuses broken JSON of any kind", "[spec][bad_files]") {
  for (const char* key : {"main", "rig", "machine", "other"}) {
    for (const BadFile& bad : broken_json(key)) {
      if (std::string(bad.name) == "huge" || std::string(bad.name) == "deep") continue;
      DYNAMIC_SECTION(key) { check_refused(bad, {"check", "bad.json"}); }
    }
  }
}

TEST_CASE("a bad plan is refused with line, pointer and reason, all faults at once",
          "[spec][bad_files]") {
  const std::vector<BadFile> plans{
      {"missing keys",
       "{\"main\": []}",
       {":1: /name: this key is missing", ":1: /specimen: this key is missing",
        ":1: /interlocks: this key is missing", ":1: /setup: this key is missing"}},
      {"wrong types",
       with("\"name\": \"short\"", "\"name\": 7"),
       {":2: /name: expected a text, found 7"}},
      {"text for a number",
       with("\"gear_ratio\": 121", "\"gear_ratio\": \"121\""),
       {":3: /specimen/gear_ratio: expected a number, found \"121\""}},
      {"out of bounds",
       with("\"speeds_rpm\": [1210]", "\"speeds_rpm\": [605, 99999]"),
       {":8: /main/0/speeds_rpm/1: 99999 is above 10000"}},
      {"misspelt key",
       with("\"load_pct\": 50", "\"load_pc\": 50"),
       {":7: /setup/1/load_pct: this key is missing",
        ":7: /setup/1/load_pc: unknown key, did you mean \"load_pct\"?"}},
  };
  for (const BadFile& bad : plans) {
    check_refused(bad, {"run", "bad.json", "--rig", "sim", "--serial", "A"});
  }
}

TEST_CASE("a plan that reads well but makes no sense is refused likewise", "[spec][bad_files]") {
  const std::vector<BadFile> plans{
      {"unknown phase", with("\"warm_up\"", "\"warmup\""), {":7: /setup/1/phase: "}},
      {"no connect", with("{\"phase\": \"connect\"},", ""), {"\"connect\" comes once"}},
      {"no points",
       with("\"speeds_rpm\": [1210]", "\"speeds_rpm\": []"),
       {":8: /main/0/speeds_rpm: must not be empty"}},
      {"record too short",
       with("\"output_turns\": 4", "\"output_turns\": 3"),
       {":9: /main/0/record/output_turns: 3 is below 4"}},
      {"too many points",
       with("\"speeds_rpm\": [1210]",
            "\"speeds_rpm\": [1210], "
            "\"repeats\": 1000, \"order\": \"x\""),
       {":8: /main/0/order: expected one of"}},
      {"interlock below the plan",
       with("\"input_speed_rpm\": 2200", "\"input_speed_rpm\": 1200"),
       {":4: /interlocks/input_speed_rpm: 1200 is not above the plan's fastest speed, 1210 rpm"}},
      {"watchdog",
       with("\"connect\"", "\"connect\", \"watchdog_max_s\": 60"),
       {":6: /setup/0/watchdog_max_s: 60 is above 2"}},
  };
  for (const BadFile& bad : plans) {
    check_refused(bad, {"run", "bad.json", "--rig", "sim", "--serial", "A"});
  }
}

TEST_CASE("a bad rig is refused before anything else happens", "[spec][bad_files]") {
  const std::vector<BadFile> rigs{
      {"unknown kind", "{\"rig\": \"smi\"}", {":1: /rig: expected one of", "did you mean \"sim\""}},
      {"unknown preset",
       "{\"rig\": \"sim\", \"preset\": \"healty\"}",
       {":1: /preset: ", "did you mean \"healthy\"?"}},
      {"fault",
       "{\"rig\": \"sim\", \"faults\": [\n{\"at_s\": -1, \"device\": \"inverter\","
       "\"fault\": \"dead\"}]}",
       {":2: /faults/0/at_s: -1 is below 0"}},
      {"unknown key",
       "{\"rig\": \"sim\", \"watchdog\": 1}",
       {":1: /watchdog: unknown key, did you mean \"watchdog_s\"?"}},
      {"replay of nothing", "{\"rig\": \"replay\"}", {":1: /recording: this key is missing"}},
      {"replay of what is not there",
       "{\"rig\": \"replay\", \"recording\": \"gone.h5\"}",
       {":1: /recording: gone.h5: "}},
      {"seed", "{\"rig\": \"sim\", \"seed\": -1}", {":1: /seed: -1 is below 0"}},
  };
  for (const BadFile& bad : rigs) {
    check_refused(bad, {"run", "quick", "--rig", "bad.json", "--serial", "A"});
  }
}

TEST_CASE("bad kinematics are refused by judge and by check", "[spec][bad_files]") {
  const std::vector<BadFile> machines{
      {"no machine", "{\"shafts\": [{\"name\": \"in\"}]}", {":1: /machine: this key is missing"}},
      {"no shafts", "{\"machine\": \"m\"}", {":1: /shafts: this key is missing"}},
      {"unknown shaft",
       replaced(gears, "\"driven\": \"out\"", "\"driven\": \"uot\""),
       {":2: /meshes/0/driven: no shaft is called \"uot\""}},
      {"same name twice",
       replaced(gears, "{\"name\": \"out\"}", "{\"name\": \"in\"}"),
       {":1: /shafts/1/name: there is already a shaft \"in\""}},
      {"no teeth",
       replaced(gears, "\"driver_teeth\": 20", "\"driver_teeth\": 0"),
       {":2: /meshes/0/driver_teeth: 0 is below 1"}},
      {"half a tooth",
       replaced(gears, "\"driver_teeth\": 20", "\"driver_teeth\": 20.5"),
       {":2: /meshes/0/driver_teeth: expected a whole number, found 20.5"}},
      {"ball larger than bearing",
       replaced(gears, "\"ball_diameter_mm\": 8", "\"ball_diameter_mm\": 80"),
       {":4: /bearings/0/ball_diameter_mm: must be below pitch_diameter_mm"}},
      {"pins and lobes",
       "{\"machine\": \"m\", \"rv_reducer\": {\"sun_teeth\": 9, "
       "\"planet_teeth\": 27, \"lobes\": 39,\n\"pins\": 39}}",
       {":2: /rv_reducer/pins: must be one more than lobes (39)"}},
  };
  for (const BadFile& bad : machines) {
    check_refused(bad, {"judge", "any.csv", "--kinematics", "bad.json"});
  }
  const ScratchFolder scratch;
  bench::write_file(scratch.path() / "good.json", gears);
  CHECK(test::rvbench(scratch.path(), {"check", "good.json"}).code == 0);
}

TEST_CASE("what is no file is refused by name", "[spec][bad_files]") {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path() / "folder.json");
  std::filesystem::create_directory(scratch.path() / "folder.h5");
  bench::write_file(scratch.path() / "secret.json", "{}");
  std::filesystem::permissions(scratch.path() / "secret.json", std::filesystem::perms::none);
  const auto refused = [&](const std::vector<std::string>& arguments, int code,
                           const std::string& told) {
    const Answer answer = test::rvbench(scratch.path(), arguments);
    INFO(arguments.back());
    check_civil(answer);
    CHECK(answer.code == code);
    CHECK_THAT(answer.err, Contains(told));
  };
  refused({"check", "nowhere.json"}, 3, "nowhere.json: cannot be read: No such file");
  refused({"check", "folder.json"}, 3, "folder.json: no run folder: it holds no plan.json");
  refused({"run", "folder.json", "--rig", "sim", "--serial", "A"}, 3,
          "folder.json: cannot be read: it is a folder");
  refused({"run", "quick", "--rig", "folder.json", "--serial", "A"}, 3,
          "folder.json: cannot be read: it is a folder");
  refused({"run", "quick", "--rig", "nowhere.json", "--serial", "A"}, 3,
          "nowhere.json: cannot be read: No such file");
  refused({"judge", "folder.h5", "--kinematics", "rv20e"}, 20, "folder.h5: is a folder");
  refused({"judge", "nowhere.h5", "--kinematics", "rv20e"}, 20, "nowhere.h5: no such file");
  refused({"judge", "/dev/zero", "--kinematics", "rv20e"}, 20, "/dev/zero: is no file");
  refused({"check", "/dev/zero"}, 3, "/dev/zero: cannot be read: it is no regular file");
  refused({"report", "nowhere"}, 3, "nowhere/plan.json: cannot be read: No such file");
  // What cannot even be looked at, as in a folder that is closed to us: true for root, too.
  std::filesystem::create_symlink("loop.json", scratch.path() / "loop.json");
  const std::string endless(300, 'x');
  for (const auto& [name, told] : {std::pair<std::string, std::string>{"loop.json", "Too many"},
                                   {endless, "File name too long"}}) {
    refused({"check", name}, 3, name + ": cannot be read: " + told);
    refused({"run", name, "--rig", "sim", "--serial", "A"}, 3, name + ": cannot be read: " + told);
    refused({"run", "quick", "--rig", name, "--serial", "A"}, 3, ": cannot be read: " + told);
    refused({"judge", "any.csv", "--kinematics", name}, 3, name + ": cannot be read: " + told);
  }
  if (::geteuid() != 0) {  // nothing is unreadable for root
    refused({"check", "secret.json"}, 3, "secret.json: cannot be read: Permission denied");
  }
}

}  // namespace rvbench
