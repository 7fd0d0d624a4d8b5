#include "bench/rig_file.hpp"

#include <catch2/catch.hpp>

#include "bench/text_file.hpp"
#include "sim/plant_json.hpp"
#include "sim/rv_plant.hpp"
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

// A rig of this plant, in a file of its own beside it.
std::string rig_on(const rvbench::test::ScratchFolder& scratch, const std::string& plant) {
  const std::string plant_file = (scratch.path() / "plant.json").string();
  const std::string rig_file = (scratch.path() / "rig.json").string();
  write_file(plant_file, plant);
  write_file(rig_file, R"({"rig": "sim", "plant": ")" + plant_file + "\"}");
  return rig_file;
}

// Mean of what a rig's transducer shows while it idles at 605 rpm.
double idling_torque_Nm(const std::string& rig_file) {
  auto made = make_rig(rig_file, {});
  REQUIRE(made.index() == 0);
  const hal::Rig& rig = std::get<0>(made);
  REQUIRE(rig.drive->connect());
  REQUIRE(rig.torque_sensor->connect());
  REQUIRE(rig.drive->set_speed(605));
  double sum_Nm = 0, samples = 0;
  for (int i = 1; i <= 60; ++i) {
    rig.clock->wait_until(0.1 * i);
    REQUIRE(rig.drive->read());
    const auto block = rig.torque_sensor->read();
    REQUIRE(block);
    if (i <= 40) continue;
    for (const hal::TorqueSample& sample : block.value().samples) sum_Nm += sample.torque_Nm;
    samples += static_cast<double>(block.value().samples.size());
  }
  return sum_Nm / samples;
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

TEST_CASE("every rig has a plant that stands for what it turns", "[bench]") {
  CHECK(plant_of(SimRig{}) == "rv20e_bench");
  CHECK(plant_of(std::get<0>(read(R"({"rig": "replay", "recording": "r.h5"})"))) == "rv20e_bench");
  CHECK(plant_of(std::get<0>(read(
            R"({"rig": "replay", "recording": "r.h5", "plant": "mine.json"})"))) == "mine.json");

  const rvbench::test::ScratchFolder scratch;
  write_file(scratch / "rig.json", R"({"rig": "replay", "recording": "r.h5", "plant": "rv20"})");
  const auto faults = check_rig(scratch / "rig.json");
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].pointer == "/plant");
}

TEST_CASE("a rig file goes before the command line, which fills in what it leaves open",
          "[bench]") {
  const SimRig open = sim_of(R"({"rig": "sim"})", {.preset = "cycloid_pin", .seed = 7});
  CHECK(open.preset == "cycloid_pin");
  CHECK(open.seed == 7);
  CHECK_FALSE(open.holding_brake);
  CHECK(sim_of(R"({"rig": "sim", "holding_brake": true})").holding_brake);
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

TEST_CASE("how grave a simulated fault is may be said, else the seed draws it", "[bench]") {
  CHECK(sim_of(R"({"rig": "sim", "preset": "cycloid_pin"})").severity == std::nullopt);
  CHECK(sim_of(R"({"rig": "sim"})", {.severity = 0.5}).severity == 0.5);
  CHECK(sim_of(R"({"rig": "sim", "severity": 0.25})", {.severity = 0.5}).severity == 0.25);
  CHECK(faults_of(R"({"rig": "sim", "severity": -1})").front().pointer == "/severity");
  const auto of_option = read_rig("sim", {.severity = 1000});
  REQUIRE(of_option.index() == 1);
  CHECK(std::get<1>(of_option).front().pointer == "/severity");
  CHECK(rig_to_json("sim", {.severity = 0.25}).find("\"severity\": 0.25") != std::string::npos);
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

SCENARIO("a rig file may name another plant for the simulated bench", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  GIVEN("the drawing's plant, with dry friction of 0.2 N·m more on the input shaft") {
    const auto rubbing =
        sim::with_effect(sim::rv20e_bench(), "coulomb_friction", {.body_a = "input_shaft"},
                         {{"level", {0.2, "N·m"}}, {"creep_speed", {1, "rad/s"}}});
    const double base_Nm = idling_torque_Nm("sim");
    THEN("the rig's transducer shows as much more, and without it the same") {
      CHECK(idling_torque_Nm(rig_on(scratch, sim::write_plant(rubbing))) ==
            Approx(base_Nm + 0.2).margin(0.002));
      CHECK(idling_torque_Nm(rig_on(scratch, sim::write_plant(sim::rv20e_bench()))) == base_Nm);
    }
  }
  GIVEN("a plant file with faults") {
    std::string text = sim::write_plant(sim::rv20e_bench());
    text.replace(text.find("\"shaft_torsion\""), 15, "\"shaft_tension\"");
    const std::vector<hal::ConfigFault> faults = check_rig(rig_on(scratch, text));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].pointer == "/plant");
    CHECK_THAT(faults[0].message, Catch::Contains("plant.json:") &&
                                      Catch::Contains("/terms/1/type: no type of term") &&
                                      Catch::Contains("did you mean \"shaft_torsion\"?"));
    CHECK(make_rig((scratch.path() / "rig.json").string(), {}).index() == 1);
  }
  GIVEN("a machine that is no bench of a reducer") {
    const auto emps = std::get<sim::PlantSpec>(sim::read_plant("emps"));
    const std::vector<hal::ConfigFault> faults = check_rig(rig_on(scratch, sim::write_plant(emps)));
    REQUIRE(!faults.empty());
    CHECK(faults[0].pointer == "/plant");
    CHECK_THAT(faults[0].message, Catch::Contains("the bench needs a body called \"motor\""));
  }
}

TEST_CASE("a replay rig names its recording", "[bench]") {
  const auto file = read(R"({"rig": "replay", "recording": "a.h5", "rated_output_torque_Nm": 50})");
  REQUIRE(file.index() == 0);
  const ReplayRig replay = std::get<ReplayRig>(std::get<0>(file));
  CHECK(replay.recording == "a.h5");
  CHECK(replay.rated_output_torque_Nm == 50);
  CHECK(replay.pace == "virtual");
}

TEST_CASE("a replay rig may be played at the pace of real time", "[bench]") {
  const std::string rig = R"({"rig": "replay", "recording": "a.h5", "pace": "real_time"})";
  CHECK(std::get<ReplayRig>(std::get<0>(read(rig))).pace == "real_time");
  const auto faults = faults_of(R"({"rig": "replay", "recording": "a.h5", "pace": "real time"})");
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].pointer == "/pace");
  CHECK_THAT(faults[0].message, Catch::Contains("did you mean \"real_time\"?"));

  const rvbench::test::ScratchFolder scratch;
  write_file(scratch / "rig.json", rig);
  const std::string resolved = rig_to_json((scratch / "rig.json").string(), {});
  CHECK_THAT(resolved, Catch::Contains("\"pace\": \"real_time\""));
  write_file(scratch / "resolved.json", resolved);
  CHECK(rig_to_json((scratch / "resolved.json").string(), {}) == resolved);
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

TEST_CASE("a rig of a kind that there is not, or that lacks what its kind needs, is a fault",
          "[bench]") {
  const auto told = [](const std::string& text) {
    return describe("rig.json", faults_of(text).at(0));
  };
  CHECK_THAT(told(R"({"rig": "smi"})"),
             Catch::Contains("/rig: expected one of") && Catch::Contains("did you mean \"sim\"?"));
  CHECK_THAT(told(R"({"rig": "replay"})"), Catch::Contains("/recording: this key is missing"));
  CHECK_THAT(told(R"({"faults": [{"at_s": -1, "device": "inverter", "fault": "dead"}]})"),
             Catch::Contains("/faults/0/at_s: -1 is below 0"));
}

TEST_CASE("a seed that is no whole number is a fault", "[bench]") {
  CHECK(faults_of(R"({"rig": "sim", "seed": 1.5})").at(0).pointer == "/seed");
}

}  // namespace rvbench::bench
