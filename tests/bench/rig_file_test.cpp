#include "bench/rig_file.hpp"

#include <catch2/catch.hpp>

#include "bench/run_folder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

std::variant<RigFile, std::vector<hal::ConfigFault>> read(const std::string& text,
                                                          const RigOptions& options = {}) {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch.path() / "rig.json", text);
  return read_rig((scratch.path() / "rig.json").string(), options);
}

SimRig sim_of(const std::string& text, const RigOptions& options = {}) {
  const auto file = read(text, options);
  REQUIRE(file.index() == 0);
  return std::get<SimRig>(std::get<0>(file));
}

std::vector<hal::ConfigFault> faults_of(const std::string& text) {
  auto file = read(text);
  REQUIRE(file.index() == 1);
  return std::get<1>(std::move(file));
}

}  // namespace

TEST_CASE("the built-in rig is the simulated bench with the unit asked for", "[bench]") {
  const auto file = read_rig("sim", {.preset = "cycloid_pin", .seed = 7});
  REQUIRE(file.index() == 0);
  const SimRig sim = std::get<SimRig>(std::get<0>(file));
  CHECK(sim.preset == "cycloid_pin");
  CHECK(sim.seed == 7);
  CHECK(sim.watchdog_s > 0);
  CHECK(sim.faults.empty());
}

TEST_CASE("a rig file goes before the command line, which fills in what it leaves open",
          "[bench]") {
  const SimRig open = sim_of(R"({"rig": "sim"})", {.preset = "cycloid_pin", .seed = 7});
  CHECK(open.preset == "cycloid_pin");
  CHECK(open.seed == 7);
  const SimRig said = sim_of(R"({"rig": "sim", "preset": "healthy", "seed": 9007199254740991,
    "watchdog_s": 0, "faults": [{"at_s": 2.5, "device": "inverter", "fault": "late"}]})",
                             {.preset = "cycloid_pin", .seed = 7});
  CHECK(said.preset == "healthy");
  CHECK(said.seed == 9007199254740991);  // 2^53 - 1: the largest that JSON numbers hold exactly
  CHECK(said.watchdog_s == 0);
  REQUIRE(said.faults.size() == 1);
  CHECK(said.faults[0].at_s == 2.5);
  CHECK(said.faults[0].device == "inverter");
  CHECK(said.faults[0].fault == "late");
}

TEST_CASE("faults of one device come one after the other, each at its time", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  const std::string file = (scratch.path() / "rig.json").string();
  write_file(file, R"({"rig": "sim", "faults": [
    {"at_s": 0.2, "device": "inverter", "fault": "busy"},
    {"at_s": 0.4, "device": "inverter", "fault": "dead"}]})");
  auto made = make_rig(file, {});
  REQUIRE(made.index() == 0);
  const hal::Rig& rig = std::get<0>(made);
  REQUIRE(rig.drive->connect());
  rig.clock->wait_until(0.3);
  const auto busy = rig.drive->read();
  REQUIRE_FALSE(busy);
  CHECK(busy.error().code == IoErrc::refused);
  rig.clock->wait_until(0.5);
  const auto dead = rig.drive->read();
  REQUIRE_FALSE(dead);
  CHECK(dead.error().code == IoErrc::disconnected);
}

TEST_CASE("a fault at time zero is there before the first request", "[bench]") {
  const test::ScratchFolder scratch;
  const std::string file = (scratch.path() / "rig.json").string();
  write_file(file, R"({"faults": [{"at_s": 0, "device": "inverter", "fault": "dead"}]})");
  auto made = make_rig(file, {});
  REQUIRE(made.index() == 0);
  CHECK_FALSE(std::get<0>(made).drive->connect());
}

TEST_CASE("a replay rig names its recording", "[bench]") {
  const auto file = read(R"({"rig": "replay", "recording": "a.h5", "rated_output_torque_Nm": 50})");
  REQUIRE(file.index() == 0);
  const ReplayRig replay = std::get<ReplayRig>(std::get<0>(file));
  CHECK(replay.recording == "a.h5");
  CHECK(replay.rated_output_torque_Nm == 50);
}

TEST_CASE("the resolved rig is a rig file that says the same", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  const std::string first = (scratch.path() / "first.json").string();
  const std::string second = (scratch.path() / "second.json").string();
  write_file(first, R"({"faults": [{"at_s": 2.5, "device": "inverter", "fault": "dead"}]})");
  write_file(second, rig_to_json(first, {.preset = "planet_tooth", .seed = 3}));
  CHECK(check_rig(second).empty());
  CHECK(rig_to_json(second, {}) == rig_to_json(first, {.preset = "planet_tooth", .seed = 3}));
  CHECK(rig_to_json(second, {}).find("planet_tooth") != std::string::npos);
}

TEST_CASE("every fault of a rig file is reported at once, with its place", "[bench]") {
  const auto faults = faults_of(R"({"rig": "sim", "seed": -1, "watchdog_s": 1000,
"faults": [{"at_s": 1, "device": "inverter", "fault": "laet"},
5], "presett": "healthy"})");
  std::vector<std::string> places;
  for (const auto& fault : faults) places.push_back(fault.pointer);
  CHECK(places == std::vector<std::string>{"/seed", "/watchdog_s", "/faults/0/fault", "/faults/1",
                                           "/presett"});
  CHECK_THAT(faults[2].message, Catch::Contains("did you mean \"late\"?"));
  CHECK_THAT(faults[4].message, Catch::Contains("did you mean \"preset\"?"));
}

TEST_CASE("a seed that is no whole number is a fault", "[bench]") {
  CHECK(faults_of(R"({"rig": "sim", "seed": 1.5})").at(0).pointer == "/seed");
}

}  // namespace rvbench::bench
