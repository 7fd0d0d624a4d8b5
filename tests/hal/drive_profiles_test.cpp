#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>

#include "hal/drive_files.hpp"
#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/drive_words.hpp"
#include "tests/support/bytes_in.hpp"
#include "tests/support/replaced.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/this_build.hpp"

using namespace rvbench;
using namespace rvbench::hal;

namespace {

std::string text_of(const std::string& drive) {
  for (const EmbeddedFile& file : drive_files()) {
    if (file.name == drive) return file.text;
  }
  return "";
}

std::string changed(const std::string& drive, const std::string& from, const std::string& to) {
  return test::replaced(text_of(drive), from, to);
}

// What is wrong with a profile, as a user sees it.
std::string faults_of(const std::string& text) {
  const test::ScratchFolder folder;
  const auto file = folder.path() / "drive.json";
  std::ofstream(file) << text;
  const auto read = read_drive_profile(file.string());
  std::string all;
  if (read.index() == 0) return all;
  for (const ConfigFault& fault : std::get<1>(read)) {
    all += fault.pointer + ": " + fault.message + "\n";
  }
  return all;
}

}  // namespace

TEST_CASE("every built-in drive can be read, and is called what its file is called",
          "[hal][modbus]") {
  CHECK(drive_names() == std::vector<std::string>{"abb_acs", "danfoss_fc", "delta_ms300",
                                                  "rvbench_generic", "schneider_altivar",
                                                  "siemens_v20"});
  for (const std::string& name : drive_names()) {
    INFO(name);
    CHECK(faults_of(text_of(name)) == "");
    CHECK(drive_profile(name).name == name);
  }
  CHECK_THROWS_AS(drive_profile("abb"), std::invalid_argument);
  const auto unknown = read_drive_profile("acme");
  REQUIRE(unknown.index() == 1);
  CHECK_THAT(std::get<1>(unknown).front().message,
             Catch::Contains("there are: abb_acs, danfoss_fc"));
}

TEST_CASE("the README tells each key of a profile, and its example can be read", "[hal][modbus]") {
  const std::string readme = test::bytes_in(test::source_dir() / "hal/modbus/drives/README.md");
  const auto begin = readme.find("```json\n") + 8;
  CHECK(faults_of(readme.substr(begin, readme.find("```", begin) - begin)) == "");
  const std::regex key("\"([a-zA-Z_]+)\": ");
  for (const EmbeddedFile& file : drive_files()) {
    const std::string text = file.text;
    for (std::sregex_iterator at(text.begin(), text.end(), key), end; at != end; ++at) {
      INFO(file.name);
      CHECK_THAT(readme, Catch::Contains("`" + (*at)[1].str() + "`") ||
                             Catch::Contains("\"" + (*at)[1].str() + "\""));
    }
  }
}

TEST_CASE("a profile names no file of the simulator", "[hal][modbus]") {
  for (const EmbeddedFile& file : drive_files()) {
    INFO(file.name);
    CHECK_THAT(std::string(file.text), !Catch::Contains("sim/"));
  }
}

TEST_CASE("nothing but commands is ever written", "[hal][modbus]") {
  for (const std::string& name : drive_names()) {
    INFO(name);
    const DriveProfile profile = drive_profile(name);
    const std::size_t commands = name == "delta_ms300" ? 3 : 2;
    CHECK(profile.writable.size() == commands);
    for (const DriveBlock& block : watchdog_blocks(profile)) {
      CHECK(std::ranges::find(profile.writable, block.address) == profile.writable.end());
    }
  }
}

TEST_CASE("a register is told as the manual prints it, and the profile says how that is",
          "[hal][modbus]") {
  CHECK(drive_profile("siemens_v20").control == 0x63);  // 40100
  CHECK(drive_profile("abb_acs").control == 0);         // 40001
  CHECK(drive_profile("abb_acs").watchdog->timeout_s.address == 3018);
  CHECK(drive_profile("danfoss_fc").control == 49999);  // 50000 of one-based numbers
  CHECK(drive_profile("schneider_altivar").control == 8501);
  CHECK_THAT(faults_of(changed("abb_acs", "  \"addressing\": \"4x\",\n", "")),
             Catch::Contains("/addressing: this key is missing"));
  CHECK_THAT(faults_of(changed("abb_acs", "\"40002\", \"unit\"", "\"2\", \"unit\"")),
             Catch::Contains("there is no register 2 where the addressing is 4x"));
}

TEST_CASE("what was found in one source only is told", "[hal][modbus]") {
  CHECK(drive_profile("rvbench_generic").unverified.empty());
  CHECK(drive_profile("delta_ms300").unverified ==
        std::vector<std::string>{"is_remote", "is_reverse", "current_A", "watchdog time-out"});
}

TEST_CASE("a profile's faults come all at once, each with its place", "[hal][modbus]") {
  std::string text = changed("delta_ms300", "\"0x2001\", \"unit\"", "\"2o01\", \"unit\"");
  text.replace(text.find("\"source\": \"gs10\""), 16, "\"source\": \"hearsay\"");
  text.replace(text.find("\"0x0012\""), 8, "\"0x10012\"");
  const std::string faults = faults_of(text);
  CHECK_THAT(faults, Catch::Contains("/reference/register: expected a number such as"));
  CHECK_THAT(faults, Catch::Contains("\"hearsay\" is not among \"sources\""));
  CHECK_THAT(faults, Catch::Contains("/control/forward: 0x10012 does not fit into 16 bits"));
}

TEST_CASE("a profile that would write beyond its own list is refused", "[hal][modbus]") {
  CHECK_THAT(faults_of(changed("delta_ms300", "\"0x2001\", \"0x2002\"]", "\"0x2001\"]")),
             Catch::Contains("/reset: its register is not among \"writable\""));
  CHECK_THAT(faults_of(changed("delta_ms300", "[\"0x2000\", ", "[")),
             Catch::Contains("/control: its register is not among \"writable\""));
}

TEST_CASE("a key that would have no effect is refused by name", "[hal][modbus]") {
  const auto with = [](const char* drive, const std::string& before, const std::string& more) {
    return faults_of(changed(drive, before, before + more));
  };
  const std::string reference = R"("reference": {"register": "0x2001", )";
  CHECK_THAT(with("delta_ms300", reference, R"("words": 2, )"),
             Catch::Contains("/reference/words: has no effect"));
  CHECK_THAT(with("delta_ms300", reference, R"("mask": "0x0FFF", )"),
             Catch::Contains("/reference/mask: has no effect"));
  CHECK_THAT(with("danfoss_fc", R"("16140", "words": 2, )", R"("mask": "0x0FFF", )"),
             Catch::Contains("/current_A/mask: has no effect"));
  CHECK_THAT(with("delta_ms300", R"("fault_code": {"register": "0x2100", )", R"("signed": true, )"),
             Catch::Contains("/fault_code/signed: has no effect"));
  CHECK_THAT(with("siemens_v20", R"("writes_blocks": false,)",
                  R"("is_reverse": {"register": "40110", "is": "0x4000", "source": "v20_2019"},)"),
             Catch::Contains("/is_reverse: has no effect"));
  const auto with_step_from = [&](const std::string& state) {
    return with("danfoss_fc", R"("word": "0x043C", "source": "fc100"})",
                R"(, {"from": ")" + state + R"(", "word": "0x0001", "source": "fc100"})");
  };
  CHECK_THAT(with_step_from("running"),
             Catch::Contains("/steps/1/from: has no effect: it runs already"));
  CHECK_THAT(with_step_from("fault"),
             Catch::Contains("/steps/1/from: has no effect: it has tripped"));
  CHECK_THAT(with_step_from("inhibited"),
             Catch::Contains("/steps/1/from: has no effect: an earlier step"));
  CHECK_THAT(with_step_from("quick_stop"),
             Catch::Contains("/steps/1/from: has no effect: none of"));
  CHECK(with_step_from("ready") == "");
}

TEST_CASE("what a drive does when nobody talks to it is told in whole numbers", "[hal][modbus]") {
  CHECK_THAT(faults_of(changed("delta_ms300", "[1, 2]", "[1, 2.5]")),
             Catch::Contains("/watchdog/action/stops: expected whole numbers"));
}

TEST_CASE("a state that no word leads to is missed", "[hal][modbus]") {
  CHECK_THAT(faults_of(changed("delta_ms300", "\"state\": \"fault\"", "\"state\": \"ready\"")),
             Catch::Contains("/states: none of them is fault"));
  CHECK_THAT(faults_of(changed("delta_ms300", "\"state\": \"fault\"", "\"state\": \"falut\"")),
             Catch::Contains("did you mean \"fault\"?"));
}
