#include "bench/bench_rig.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/rig_factory.hpp"
#include "bench/run_folder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Contains;
using Json = nlohmann::ordered_json;

constexpr const char* sheet = R"(
BO_ 385 TorqueData: 8 Transducer
 SG_ Torque : 0|32@1- (1e-06,0) [-2147|2147] "Nm" Bench
 SG_ Angle : 32|16@1+ (0.0054931640625,0) [0|360] "deg" Bench
 SG_ Counter : 48|8@1+ (1,0) [0|255] "" Bench
)";

Json example() {
  return Json::parse(read_file(RVBENCH_SOURCE_DIR "/bench/rigs/rv20e_bench.json").value());
}

struct RigOnDisk {
  std::string path(const std::string& name = "rig.json") const {
    return (scratch.path() / name).string();
  }
  std::vector<hal::ConfigFault> faults(const Json& rig) const {
    write_file(path(), rig.dump(2));
    return check_rig(path());
  }
  // What is wrong, as a user sees it.
  std::string told(const Json& rig) const {
    std::string all;
    for (const auto& fault : faults(rig)) all += fault.pointer + ": " + fault.message + "\n";
    return all;
  }
  // Why no run can be made of it.
  std::string refusal(const Json& rig) const {
    write_file(path(), rig.dump(2));
    const auto made = make_rig(path(), {});
    if (made.index() == 0) return "";
    const hal::ConfigFault& fault = std::get<1>(made).at(0);
    return fault.pointer + ": " + fault.message;
  }

  test::ScratchFolder scratch;
};

}  // namespace

TEST_CASE("a bench of real devices is a rig, with a clock of its own", "[bench][rig]") {
  const RigOnDisk disk;
  CHECK(disk.told(example()) == "");
  write_file(disk.path(), example().dump());
  auto made = make_rig(disk.path(), {});
  REQUIRE(made.index() == 0);
  const hal::Rig& rig = std::get<0>(made);
  CHECK_FALSE(rig.clock->is_virtual());
  CHECK(rig.drive->limits().max_speed_rpm == 1900);
  CHECK(rig.brake->limits().max_torque_Nm == 400);
  CHECK(rig.torque_sensor->rate_Hz() == 500);
  CHECK(rig.accelerometers->channels().at(0).name == "accel_1x");
  CHECK(rig.buses.size() == 1);
}

TEST_CASE("the resolved bench has every default, and reads as the same bench", "[bench][rig]") {
  const RigOnDisk disk;
  write_file(disk.path("sheet.dbc"), sheet);
  const Json dbc{{"file", disk.path("sheet.dbc")},
                 {"message", "TorqueData"},
                 {"torque", "Torque"},
                 {"angle", "Angle"},
                 {"counter", "Counter"}};
  for (const Json& frames :
       {Json("rvbench"), Json{{"dbc", dbc}}, Json{{"canopen", {{"node", 7}}}}}) {
    for (const Json& can : {Json{{"socketcan", "can0"}}, example().at("can")}) {
      Json rig = example();
      rig["torque"]["frames"] = frames;
      rig["can"] = can;
      rig["safety"]["temperature"] = {{"holding_register", 4}};
      CHECK(disk.told(rig) == "");
      const std::string resolved = rig_to_json(disk.path(), {});
      INFO(resolved);
      write_file(disk.path("again.json"), resolved);
      CHECK(check_rig(disk.path("again.json")).empty());
      CHECK(rig_to_json(disk.path("again.json"), {}) == resolved);
      for (const char* word : {"deadline_s", "holding_register", "offset_degC", "period_s"}) {
        CHECK_THAT(resolved, Contains(word));
      }
    }
  }
}

SCENARIO("everything that is wrong with a bench is told at once, with its place", "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  GIVEN("a fault in each section") {
    rig["can"] = {{"slcan", {{"device", "/dev/ttyACM0"}, {"bitrate_kbit_s", 400}}}};
    rig["torque"] = {{"frames", "rvbnch"}, {"rate_Hz", 0}};
    rig["brake"] = {{"max_torque_Nm", -1}};
    rig["accelerometers"]["backend"] = "iioo";
    rig["safety"]["estop"] = {{"input", -1}, {"closed", 2}};
    rig["safety"]["temperature"] = Json::object();
    rig["safty"] = 1;
    const std::string told = disk.told(rig);
    for (const char* place :
         {"/can/slcan: SlcanTransport: bitrate_kbit_s is 400",
          "/torque/frames: ", "/torque/rate_Hz: 0 is below", "/brake/max_torque_Nm: -1 is below",
          "/accelerometers/backend: ", "/safety/estop/input: -1 is below",
          "/safety/estop/closed: 2 is above",
          "/safety/temperature: expected one of \"input_register\" and \"holding_register\"",
          "/safty: unknown key, did you mean \"safety\"?"}) {
      CHECK_THAT(told, Contains(place));
    }
  }
  GIVEN("two places for one thing, or none") {
    rig["can"] = Json::object();
    rig["safety"]["serial"] = {{"device", "/dev/ttyUSB0"}};
    rig["torque"]["frames"] = {{"dbc", Json::object()}, {"canopen", {{"node", 1}}}};
    const std::string told = disk.told(rig);
    CHECK_THAT(told, Contains("/can: expected one of \"socketcan\" and \"slcan\""));
    CHECK_THAT(told, Contains("/safety: expected one of \"tcp\" and \"serial\""));
    CHECK_THAT(told, Contains("/torque/frames: expected \"rvbench\", or one of"));
  }
  GIVEN("devices on a bus that the file does not have") {
    rig.erase("can");
    const std::string told = disk.told(rig);
    CHECK_THAT(told, Contains("/torque: it is on a CAN bus, and the file has no \"can\"") &&
                         Contains("/brake: it is on a CAN bus"));
  }
  GIVEN("both contacts on one input") {
    rig["safety"]["guard"] = rig["safety"]["estop"];
    CHECK_THAT(disk.told(rig), Contains("/safety: ") && Contains("on one input"));
  }
}

SCENARIO("a database that does not fit is told at the key that names it", "[bench][rig]") {
  const RigOnDisk disk;
  write_file(disk.path("sheet.dbc"), sheet);
  Json rig = example();
  Json& dbc = rig["torque"]["frames"] = {{"dbc",
                                          {{"file", disk.path("sheet.dbc")},
                                           {"message", "TorqueData"},
                                           {"torque", "Torque"},
                                           {"angle", "Angel"},
                                           {"counter", "Counter"}}}};
  CHECK_THAT(disk.told(rig),
             Contains("/torque/frames/dbc/angle: ") && Contains("did you mean \"Angle\"?"));
  WHEN("there is none") {
    dbc["dbc"]["file"] = disk.path("absent.dbc");
    CHECK_THAT(disk.told(rig), Contains("/torque/frames/dbc/file: cannot be read"));
  }
  WHEN("it has a fault of its own") {
    write_file(disk.path("sheet.dbc"), "BO_ 385 TorqueData 8 Transducer\n");
    CHECK_THAT(disk.told(rig), Contains("/torque/frames/dbc/file: ") && Contains("sheet.dbc:1: "));
  }
}

SCENARIO("a run is refused what it needs and the bench does not have", "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  WHEN("there is a drive alone") {
    rig = {{"rig", "bench"}, {"drive", example().at("drive")}};
    CHECK(disk.told(rig) == "");  // it can be probed
    CHECK_THAT(disk.refusal(rig), Contains("/rig: ") && Contains("\"can\", \"torque\", \"brake\", "
                                                                 "\"accelerometers\", \"safety\""));
  }
  WHEN("the transducer tells no angle") {
    rig["torque"]["frames"] = {{"canopen", {{"node", 1}}}};
    CHECK(disk.told(rig) == "");
    CHECK_THAT(disk.refusal(rig),
               Contains("/torque/frames: a run needs the angle of the input shaft"));
  }
}

}  // namespace rvbench::bench
