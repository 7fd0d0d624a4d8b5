#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "hal/can/in_process_transport.hpp"
#include "sim/brake_node.hpp"
#include "sim/transducer_node.hpp"

using namespace rvbench;

namespace {

using Data = std::array<std::uint8_t, 8>;

std::vector<hal::CanFrame> take_all(hal::CanTransport& bus) {
  std::vector<hal::CanFrame> frames;
  while (const auto frame = bus.receive()) frames.push_back(frame.value());
  return frames;
}

hal::CanFrame brake_command(int torque_dNm, int enable, int counter) {
  hal::CanFrame frame{.id = 0x201, .length = 4};
  frame.data = {static_cast<std::uint8_t>(torque_dNm % 256),
                static_cast<std::uint8_t>(torque_dNm / 256), static_cast<std::uint8_t>(enable),
                static_cast<std::uint8_t>(counter)};
  return frame;
}

}  // namespace

SCENARIO("the transducer sends one frame per sample, at its own rate", "[sim][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  sim::TransducerNode node(*bus.nodes, 100);
  const double quarter_turn_rad = std::acos(0);
  WHEN("it is told its world once in a while") {
    node.advance_to(0, 0, 0);
    node.advance_to(0.025, -2.5, quarter_turn_rad);
    node.advance_to(0.029, 0, 0);
    const auto frames = take_all(*bus.bench);
    THEN("the samples due are sent, interpolated, with a counter") {
      REQUIRE(frames.size() == 3);  // at 0, 10 and 20 ms
      CHECK(frames[0].data == Data{0, 0, 0, 0, 0, 0, 0, 0});
      // -1 N·m = -1 000 000 µN·m = 0xFFF0BDC0; 0.1 turn = 6553 = 0x1999 counts
      CHECK(frames[1].data == Data{0xC0, 0xBD, 0xF0, 0xFF, 0x99, 0x19, 1, 0});
      CHECK(frames[2].id == 0x181);
      CHECK(frames[2].length == 8);
      CHECK(frames[2].data[6] == 2);
    }
  }
  WHEN("it loses two frames") {
    node.lose_frames(2);
    node.advance_to(0.035, 0, 0);
    const auto frames = take_all(*bus.bench);
    THEN("the counter goes on") {
      REQUIRE(frames.size() == 2);
      CHECK(frames[0].data[6] == 2);
    }
  }
  WHEN("its flags are set") {
    node.set_flags({.zeroing = true, .overload = false, .shunt_on = true});
    node.advance_to(0, 0, 0);
    CHECK(take_all(*bus.bench).at(0).data[7] == 5);
  }
}

SCENARIO("the brake node obeys commands that are meant for it", "[sim][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  sim::BrakeNode node(*bus.nodes,
                      {.status_rate_Hz = 10, .comm_loss_timeout_s = 1, .max_torque_Nm = 300});
  REQUIRE(bus.bench->send(brake_command(1670, 1, 1)));
  node.advance_to(0.05, 12.34);
  CHECK(node.engaged());
  CHECK(node.setpoint_Nm() == Approx(167));
  const auto frames = take_all(*bus.bench);
  REQUIRE(frames.size() == 1);
  CHECK(frames[0].id == 0x281);
  CHECK(frames[0].length == 4);
  CHECK(frames[0].data == Data{123, 0, 1, 0});  // 12.3 N·m, engaged
  WHEN("the torque asked for is more than it can hold") {
    REQUIRE(bus.bench->send(brake_command(5000, 1, 2)));
    node.advance_to(0.1, 0);
    CHECK(node.setpoint_Nm() == Approx(300));
  }
  WHEN("frames of others or of another shape come") {
    hal::CanFrame other = brake_command(0, 0, 2);
    other.id = 0x202;
    REQUIRE(bus.bench->send(other));
    hal::CanFrame shorter = brake_command(0, 0, 3);
    shorter.length = 3;
    REQUIRE(bus.bench->send(shorter));
    node.advance_to(0.1, 0);
    CHECK(node.engaged());
  }
}

SCENARIO("the brake node releases when fresh commands stop coming", "[sim][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  sim::BrakeNode node(*bus.nodes,
                      {.status_rate_Hz = 10, .comm_loss_timeout_s = 1, .max_torque_Nm = 300});
  REQUIRE(bus.bench->send(brake_command(1670, 1, 1)));
  node.advance_to(0.05, 12.34);
  REQUIRE(node.engaged());
  WHEN("the same command comes again and again, from a sender that hangs") {
    for (int i = 1; i <= 12; ++i) {
      REQUIRE(bus.bench->send(brake_command(1670, 1, 1)));
      node.advance_to(0.05 + 0.1 * i, 0);
    }
    THEN("it does not feed the watchdog") {
      CHECK_FALSE(node.engaged());
      CHECK(take_all(*bus.bench).back().data[2] == 4);
    }
  }
  WHEN("commands stop coming") {
    node.advance_to(1.04, 0);
    CHECK(node.engaged());
    node.advance_to(1.06, 0);
    THEN("it releases, and engages again only after a command to release") {
      CHECK_FALSE(node.engaged());
      CHECK(node.setpoint_Nm() == 0);
      REQUIRE(bus.bench->send(brake_command(1670, 1, 2)));
      node.advance_to(1.1, 0);
      CHECK_FALSE(node.engaged());
      REQUIRE(bus.bench->send(brake_command(0, 0, 3)));
      REQUIRE(bus.bench->send(brake_command(1670, 1, 4)));
      node.advance_to(1.2, 0);
      CHECK(node.engaged());
    }
  }
}

TEST_CASE("a node with parameters that make no sense is the caller's bug", "[sim][can]") {
  auto bus = hal::make_in_process_bus([] { return 0.0; });
  CHECK_THROWS_AS(sim::TransducerNode(*bus.nodes, 0), std::invalid_argument);
  CHECK_THROWS_AS(sim::BrakeNode(*bus.nodes, {.status_rate_Hz = NAN}), std::invalid_argument);
}
