#include "bench/bench_rig.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/rig_factory.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/this_build.hpp"

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
  return Json::parse(read_file(test::source_dir() / "bench/rigs/rv20e_bench.json").value());
}

struct RigOnDisk {
  std::string path(const std::string& name = "rig.json") const {
    return (scratch.path() / name).string();
  }
  std::vector<hal::ConfigFault> faults(const Json& rig) const {
    write_file(path(), rig.dump(2));
    return check_rig(path());
  }
  hal::ConfigFault only_fault(const Json& rig) const {
    const auto all = faults(rig);
    REQUIRE(all.size() == 1);
    return all[0];
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
    std::string all;
    for (const auto& fault : std::get<1>(made)) all += fault.pointer + ": " + fault.message + "\n";
    return all;
  }

  rvbench::test::ScratchFolder scratch;
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
      rig["brake"]["residual_torque_pct"] = 3.5;
      CHECK(disk.told(rig) == "");
      const std::string resolved = rig_to_json(disk.path(), {});
      INFO(resolved);
      write_file(disk.path("again.json"), resolved);
      CHECK(check_rig(disk.path("again.json")).empty());
      CHECK(rig_to_json(disk.path("again.json"), {}) == resolved);
      for (const char* word : {"deadline_s", "holding_register", "offset_degC", "period_s",
                               "\"residual_torque_pct\": 3.5"}) {
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
         {"/can/slcan/bitrate_kbit_s: must be 10, 20, 50",
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
    CHECK_THAT(disk.told(rig), Contains("/safety/guard/input: ") && Contains("on one input"));
  }
}

TEST_CASE("what does not fit together is told at the value, in the words of the file",
          "[bench][rig]") {
  const RigOnDisk disk;
  const auto [place, value, told] = GENERATE(table<std::string, Json, std::string>({
      {"/drive/tcp/host", "drive.local", "\"drive.local\" is not an IPv4 address"},
      {"/drive/max_speed_rpm", 99999, "99999, must be above 0, at most 65535"},
      {"/can", {{"socketcan", "averyverylongname0"}}, "must have 1 to 15 characters"},
      {"/can/slcan/baud", 12345, "12345 is no rate of a serial line"},
      {"/torque/frames", "dbc", "found \"dbc\"; a DBC file is {\"dbc\": {\"file\": ..., "},
      {"/torque/frames", "canopen", "such a node is {\"canopen\": {\"node\": ...}}"},
      {"/torque/frames", "rvbnch", "found \"rvbnch\", did you mean \"rvbench\"?"},
      {"/accelerometers/inputs", Json::array(), "must not be empty"},
      {"/safety/temperature/scale_degC", 0, "0 makes one temperature of them all"},
      {"/safety/temperature/max_degC", -50, "no temperature is within -40 to -50 degC"},
      {"/safety/guard/input", 3000, "do not fit into one request"},
  }));
  Json rig = example();
  rig[Json::json_pointer(place)] = value;
  const std::string all = disk.told(rig);
  INFO(all);
  CHECK_THAT(all, Catch::StartsWith(place) && Contains(told));
  CHECK_THAT(all, !Contains("Transport") && !Contains("Modbus") && !Contains("make_"));
  CHECK(std::count(all.begin(), all.end(), '\n') == 1);
}

TEST_CASE("a Modbus line has a rate that there is", "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  rig["drive"].erase("tcp");
  rig["drive"]["serial"] = {{"device", "/dev/ttyUSB0"}, {"baud", 12345}};
  CHECK_THAT(disk.told(rig), Contains("/drive/serial/baud: 12345 is no rate of a Modbus line"));
  rig["drive"]["serial"]["baud"] = 57600;
  CHECK(disk.told(rig) == "");
}

TEST_CASE("a serial line serves one device, and a reply may not be waited for long",
          "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  CHECK(disk.told(rig) == "");
  rig["drive"].erase("tcp");
  rig["drive"]["serial"]["device"] = rig["can"]["slcan"]["device"];
  rig["drive"]["response_timeout_s"] = 0.31;
  const std::string told = disk.told(rig);
  CHECK_THAT(told, Contains("/can: ") && Contains("is the serial line of \"drive\", too"));
  CHECK_THAT(told, Contains("/drive/response_timeout_s: "));
}

TEST_CASE("of a device at two places, or two devices at one, the place is told", "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  SECTION("at both ends of a wire") {
    rig["drive"]["serial"]["device"] = "/dev/ttyUSB7";
    const hal::ConfigFault fault = disk.only_fault(rig);
    CHECK(fault.pointer == "/drive");
    CHECK_THAT(fault.message, Contains("expected one of \"tcp\" and \"serial\""));
  }
  SECTION("drive and safety inputs") {
    rig["safety"]["tcp"] = rig["drive"]["tcp"];
    rig["safety"]["unit_id"] = 17;
    CHECK(disk.told(rig) == "");  // behind a gateway
    rig["safety"]["unit_id"] = rig["drive"]["unit_id"];
    CHECK(disk.only_fault(rig).pointer == "/safety");
  }
  SECTION("where libiio has no way to") {
    rig["accelerometers"]["uri"] = "foo:192.168.3.30";
    CHECK(disk.only_fault(rig).pointer == "/accelerometers/uri");
  }
}

TEST_CASE("no two inputs are on one channel, and a board's channels are numbers with a sensor",
          "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  Json& inputs = rig["accelerometers"]["inputs"];
  inputs.push_back(inputs[0]);
  inputs[1]["name"] = "accel_1y";
  CHECK_THAT(disk.told(rig),
             Contains("/accelerometers/inputs/1/channel: there is another input on this channel"));
  rig["accelerometers"].erase("uri");
  rig["accelerometers"]["backend"] = "comedi";
  rig["accelerometers"]["device"] = "/dev/comedi0";
  Json& second = rig["accelerometers"]["inputs"][1];
  second["channel"] = "1";
  second.erase("sensitivity_V_per_m_s2");
  CHECK_THAT(disk.told(rig),
             Contains("/accelerometers/inputs/0/channel: \"voltage0\" is no number") &&
                 Contains("/accelerometers/inputs/1/sensitivity_V_per_m_s2: this key is missing"));
}

TEST_CASE("of a kind of rig that there is not, no key is called unknown", "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  rig["rig"] = "bnch";
  CHECK(disk.only_fault(rig).pointer == "/rig");
}

TEST_CASE("faults that are found after the reading have a line, too", "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  rig["plant"] = "rv20";
  const hal::ConfigFault fault = disk.only_fault(rig);
  CHECK(fault.pointer == "/plant");
  const std::string text = rig.dump(2);
  const auto before = text.begin() + std::ptrdiff_t(text.find("\"plant\""));
  CHECK(fault.line == 1 + std::count(text.begin(), before, '\n'));
}

TEST_CASE("a contact whose broken wire reads as safe is warned of, and works", "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  write_file(disk.path(), rig.dump(2));
  CHECK(remarks_on(disk.path()).warnings.empty());
  rig["drive"]["tcp"] = {{"host", "127.0.0.1"}, {"port", 1}};  // nobody there: refused at once
  rig["safety"]["estop"]["closed"] = 0;
  CHECK(disk.told(rig) == "");
  const auto warnings = remarks_on(disk.path()).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].pointer == "/safety/estop/closed");
  CHECK(warnings[0].line > 0);
  CHECK_THAT(warnings[0].message, Contains("a broken wire") && Contains("reads as not pressed"));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"check", disk.path()},
                                                {"run", "quick", "--rig", disk.path(), "--dry-run"},
                                                {"probe", "--rig", disk.path()}}) {
    CHECK_THAT(test::rvbench(words).err,
               Contains("warning: " + disk.path()) && Contains("/safety/estop/closed: "));
  }
}

TEST_CASE("a drive alone is checked as what it is: enough for a probe, not for a run",
          "[bench][rig]") {
  const RigOnDisk disk;
  write_file(disk.path(), Json{{"rig", "bench"}, {"drive", example().at("drive")}}.dump(2));
  const test::CommandAnswer checked = test::rvbench({"check", disk.path()});
  CHECK(checked.code == 0);
  CHECK_THAT(checked.out, Contains("fit for probe, not for a run"));
  CHECK_THAT(checked.err, Contains("note: ") && Contains("/safety: this section is missing"));
  const test::CommandAnswer planned =
      test::rvbench({"run", "quick", "--rig", disk.path(), "--dry-run"});
  CHECK(planned.code == 3);
  CHECK(planned.out.empty());
  CHECK_THAT(planned.err, Contains("/can: ") && Contains("/torque: ") && Contains("/brake: ") &&
                              Contains("/accelerometers: ") && Contains("/safety: "));
}

TEST_CASE("what a plan asks for and the rig cannot do is told before anything turns, all at once",
          "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  rig["drive"]["max_speed_rpm"] = 1500;
  rig["brake"]["max_torque_Nm"] = 100;
  rig["accelerometers"]["rate_Hz"] = 5120;
  rig["accelerometers"]["range_m_s2"] = 200;
  write_file(disk.path(), rig.dump(2));
  Json plan = Json::parse(read_file(test::source_dir() / "sequences/plans/quick.json").value());
  plan["acceleration_rate_Hz"] = 4960;
  write_file(disk.path("plan.json"), plan.dump(2));
  for (const char* how : {"--dry-run", "--json"}) {
    const test::CommandAnswer answer =
        test::rvbench({"run", disk.path("plan.json"), "--rig", disk.path(), "--serial", "A",
                       "--out", disk.path("runs"), how});
    CHECK(answer.code == 3);
    CHECK_THAT(answer.err,
               Contains("/acceleration_rate_Hz: the accelerometers run at 5120 Hz, the plan asks "
                        "for 4960 Hz") &&
                   Contains("/interlocks/acceleration_m_s2: ") && Contains("could never trip") &&
                   Contains("/main/0: the plan asks for 1815 rpm, the drive can do 1500 rpm") &&
                   Contains("/main/0: the plan asks for 167 N·m, the brake can do 100 N·m"));
    CHECK_THAT(answer.err, Catch::StartsWith("rvbench: " + disk.path("plan.json") + ":"));
  }
  CHECK_FALSE(std::filesystem::exists(disk.path("runs")));
}

TEST_CASE("a bench where nothing is there says what is not, and does not wait for a standstill",
          "[bench][rig]") {
  const RigOnDisk disk;
  Json rig = example();
  const Json nobody{{"host", "127.0.0.1"}, {"port", 1}};
  rig["drive"]["tcp"] = nobody;
  rig["safety"]["tcp"] = nobody;
  rig["safety"]["unit_id"] = 2;
  rig["can"]["slcan"]["device"] = disk.path("no_adapter");
  rig["accelerometers"]["uri"] = "ip:127.0.0.1:1";
  write_file(disk.path(), rig.dump(2));
  const auto start = std::chrono::steady_clock::now();
  const test::CommandAnswer answer =
      test::rvbench({"run", "quick", "--rig", disk.path(), "--serial", "A", "--out",
                     disk.path("runs"), "--json"});
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
  CHECK(answer.code == 30);
  const Json verdict = Json::parse(answer.out);
  CHECK(verdict.at("verdict") == "ERROR");
  CHECK_THAT(verdict.at("reason").get<std::string>(),
             Contains("not every device answers: ") && Contains("inverter 127.0.0.1:1: ") &&
                 Contains("safety inputs 127.0.0.1:1: ") && Contains("no_adapter") &&
                 Contains("accelerometers ip:127.0.0.1:1: "));
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
    const std::string told = disk.refusal(rig);
    for (const char* at : {"/can: ", "/torque: ", "/brake: ", "/accelerometers: ", "/safety: "}) {
      CHECK_THAT(told, Contains(at + std::string("this section is missing: a run needs it")));
    }
  }
  WHEN("the transducer tells no angle") {
    rig["torque"]["frames"] = {{"canopen", {{"node", 1}}}};
    CHECK(disk.told(rig) == "");
    CHECK_THAT(disk.refusal(rig),
               Contains("/torque/frames: a run needs the angle of the input shaft"));
  }
}

}  // namespace rvbench::bench
