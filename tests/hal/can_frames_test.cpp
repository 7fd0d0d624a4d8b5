#include "hal/can/can_frames.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

using namespace rvbench::hal;
using namespace rvbench::hal::can_frames;

namespace {

CanFrame frame(std::uint32_t id, std::uint8_t length, std::array<std::uint8_t, 8> data) {
  return {.id = id, .length = length, .data = data};
}

}  // namespace

TEST_CASE("a torque frame is read as its layout says", "[hal][can]") {
  // -1.5 N·m = -1 500 000 µN·m = 0xFFE91CA0; 0xC000 counts = 3/4 turn; counter 200; shunt on.
  const auto torque =
      torque_from_frame(frame(0x181, 8, {0xA0, 0x1C, 0xE9, 0xFF, 0x00, 0xC0, 200, 0x04}));
  REQUIRE(torque);
  CHECK(torque->torque_Nm == Approx(-1.5));
  CHECK(torque->angle_turns == 0.75);
  CHECK(torque->counter == 200);
  CHECK(torque->shunt_on);
  CHECK_FALSE(torque->zeroing);
  CHECK_FALSE(torque->overload);
}

TEST_CASE("a brake status is read as its layout says", "[hal][can]") {
  // 167.0 N·m = 1670 = 0x0686; engaged and command lost.
  const auto status = brake_status_from_frame(frame(0x281, 4, {0x86, 0x06, 0x05, 9}));
  REQUIRE(status);
  CHECK(status->torque_Nm == Approx(167));
  CHECK(status->engaged);
  CHECK_FALSE(status->tripped);
  CHECK(status->command_lost);
  CHECK(status->counter == 9);
}

TEST_CASE("a brake command is written as its layout says", "[hal][can]") {
  const CanFrame command =
      frame_from_brake_command({.torque_Nm = 167, .enable = true, .counter = 3});
  CHECK(command.id == 0x201);
  CHECK(command.length == 4);
  CHECK(command.data == std::array<std::uint8_t, 8>{0x86, 0x06, 1, 3, 0, 0, 0, 0});
  CHECK(frame_from_brake_command({}).data == std::array<std::uint8_t, 8>{});
  CHECK_THROWS_AS(frame_from_brake_command({.torque_Nm = 6553.6}), std::invalid_argument);
  CHECK_THROWS_AS(frame_from_brake_command({.torque_Nm = -0.1}), std::invalid_argument);
}

TEST_CASE("frames of another shape are not believed", "[hal][can]") {
  CHECK(torque_from_frame(frame(0x181, 8, {})));
  CHECK_FALSE(torque_from_frame(frame(0x182, 8, {})));
  CHECK_FALSE(torque_from_frame(frame(0x181, 7, {})));
  CHECK_FALSE(torque_from_frame(frame(0x181, 8, {0, 0, 0, 0, 0, 0, 0, 8})));
  CHECK(brake_status_from_frame(frame(0x281, 4, {})));
  CHECK_FALSE(brake_status_from_frame(frame(0x281, 5, {})));
  CHECK_FALSE(brake_status_from_frame(frame(0x281, 4, {0, 0, 8, 0})));
}
