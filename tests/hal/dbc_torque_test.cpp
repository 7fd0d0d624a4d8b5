#include "hal/can/dbc_torque.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "hal/can/can_torque_sensor.hpp"
#include "tests/hal/can_bench.hpp"
#include "tests/hal/dbc_text.hpp"

using namespace rvbench;
using namespace rvbench::hal;

namespace {

const std::string sheet = std::string(test::torque_data) + R"(BO_ 386 Slow: 2 Transducer
 SG_ Temperature : 0|16@1- (0.1,0) [0|0] "degC" Bench
 SG_ Nibble : 0|4@1+ (1,0) [0|0] "" Bench
VAL_ 385 State 0 "sound" 4 "shunt on" ;
VAL_ 999 Elsewhere 0 "of a message that is not there" ;
VAL_ Environment 0 "of no message at all" ;
)";

const DbcTorqueNames names{.message = "TorqueData",
                           .torque = "Torque",
                           .angle = "Angle",
                           .counter = "Counter",
                           .status = "State"};

dbc::Database database(const std::string& more = "") {
  return std::get<0>(dbc::parse(sheet + more));
}

std::string faults_of(const DbcTorqueNames& of, const std::string& more = "") {
  return test::faults_in(torque_decoder(database(more), of));
}

}  // namespace

TEST_CASE("a transducer that is told by a database reads as one that is built in",
          "[hal][can][dbc]") {
  const auto decode = std::get<0>(torque_decoder(database(), names));
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    const CanFrame frame{
        .id = 0x181,
        .length = 8,
        .data = {byte, static_cast<std::uint8_t>(7 * i), 3,
                 static_cast<std::uint8_t>(i % 2 == 0 ? 0 : 0xFF), byte, byte, byte, 0}};
    const auto built_in = can_frames::torque_from_frame(frame);
    const auto told = decode(frame);
    REQUIRE(built_in);
    REQUIRE(told);
    CHECK(told->torque_Nm == Approx(built_in->torque_Nm));
    CHECK(told->angle_turns == Approx(built_in->angle_turns).margin(1e-12));
    CHECK(told->counter == built_in->counter);
  }
}

TEST_CASE("a transducer that says that something is wrong gives no torque", "[hal][can][dbc]") {
  const auto decode = std::get<0>(torque_decoder(database(), names));
  CHECK(decode({.id = 0x181, .length = 8}).value().flaw.empty());
  const auto flaw_of = [&](std::uint8_t state) {
    return decode({.id = 0x181, .length = 8, .data = {0, 0, 0, 0, 0, 0, 0, state}}).value().flaw;
  };
  CHECK(flaw_of(4) == "State: shunt on");
  CHECK(flaw_of(3) == "State: 3");
  CHECK_FALSE(decode({.id = 0x181, .length = 7}));
  CHECK_FALSE(decode({.id = 0x182, .length = 8}));
}

TEST_CASE("the sensor follows a shaft by its database", "[hal][can][dbc]") {
  test::CanBench world;
  world.brake.set_fault(sim::NodeFault::silent);  // no frames but the transducer's
  CanTorqueSensor sensor(std::move(world.bus.bench),
                         {.rate_Hz = test::CanBench::rate_Hz,
                          .decode = std::get<0>(torque_decoder(database(), names))},
                         world);
  REQUIRE(sensor.connect());
  world.wait_until(0.15);
  const auto block = sensor.read();
  REQUIRE(block);
  CHECK(block.value().lost == 0);
  CHECK(block.value().samples.back().torque_Nm ==
        Approx(test::CanBench::torque_Nm).margin(1e-6).epsilon(0));
  CHECK(block.value().samples.back().angle_rad ==
        Approx(test::CanBench::angle_rad(0.15)).margin(0.02));
}

TEST_CASE("only the signals that are read must be integers", "[hal][can][dbc]") {
  CHECK(faults_of(names, "SIG_VALTYPE_ 386 Temperature : 1;\n") == "");
  CHECK_THAT(faults_of(names, "SIG_VALTYPE_ 385 Torque : 1;\n"),
             Catch::Contains("/torque: Torque is a floating-point number, expected an integer"));
  CHECK_THAT(faults_of(names, "SIG_VALTYPE_ 385 State : 2;\n"),
             Catch::Contains("/status: State is a floating-point number"));
}

TEST_CASE("names and units that a transducer cannot have are told all at once", "[hal][can][dbc]") {
  CHECK(faults_of(names) == "");
  CHECK_THAT(faults_of({.message = "Torque", .torque = "", .angle = "", .counter = ""}),
             Catch::Contains("/message: no message \"Torque\""));
  const std::string faults = faults_of(
      {.message = "TorqueData", .torque = "Torqe", .angle = "Torque", .counter = "Count"});
  CHECK_THAT(faults, Catch::Contains("/torque: TorqueData has no signal \"Torqe\""));
  CHECK_THAT(faults, Catch::Contains("did you mean \"Torque\"?"));
  CHECK_THAT(faults, Catch::Contains("/angle: Torque is in \"Nm\", expected deg"));
  CHECK_THAT(faults, Catch::Contains("/counter: "));
  CHECK_THAT(faults_of({.message = "Slow",
                        .torque = "Temperature",
                        .angle = "Temperature",
                        .counter = "Nibble"}),
             Catch::Contains("/counter: Nibble has fewer than 8 bits"));
}
