#include "hal/can/can_brake.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hal/can/can_dispatcher.hpp"
#include "tests/hal/can_bench.hpp"

using namespace rvbench;

namespace {

// A controller that may go bus-off. It is lost then until it is opened, which it cannot be before
// it has recovered.
class FragileBus final : public hal::CanTransport {
 public:
  FragileBus(std::unique_ptr<hal::CanTransport> bus, const bool& is_off)
      : bus_(std::move(bus)), is_off_(is_off) {}

  Status open() override {
    is_open_ = !is_off_;
    return is_open_ ? bus_->open() : Status(lost("open"));
  }
  Status send(const hal::CanFrame& frame) override {
    return is_lost() ? Status(lost("send")) : bus_->send(frame);
  }
  Result<hal::CanFrame> receive() override {
    if (is_lost()) return lost("receive");
    return bus_->receive();
  }

 private:
  static IoError lost(const std::string& what) { return {IoErrc::disconnected, "CAN: " + what}; }
  bool is_lost() {
    if (is_off_) is_open_ = false;
    return !is_open_;
  }

  std::unique_ptr<hal::CanTransport> bus_;
  const bool& is_off_;
  bool is_open_ = false;
};

struct Bench {
  test::CanBench world;
  bool is_bus_off = false;
  std::vector<std::unique_ptr<hal::CanTransport>> ports = hal::split_by_id(
      std::make_unique<FragileBus>(std::move(world.bus.bench), is_bus_off), {0x181, 0x281});
  hal::CanBrake brake{std::move(ports[1]), {.limits = {.max_torque_Nm = 600}}, world};

  Bench() { world.transducer.set_fault(sim::NodeFault::silent); }  // no frames but the brake's

  void hold(double torque_Nm, double duration_s) {
    const double end_s = world.now_s() + duration_s;
    while (world.now_s() < end_s) {
      REQUIRE(brake.set_torque(torque_Nm));
      world.wait_until(world.now_s() + 0.1);
    }
  }
};

}  // namespace

SCENARIO("the brake holds what it is told, to 0.1 N·m", "[hal][can]") {
  Bench bench;
  REQUIRE(bench.brake.connect());
  CHECK_FALSE(bench.world.brake.engaged());
  bench.hold(167.04, 3);
  CHECK(bench.world.brake.setpoint_Nm() == Approx(167.0));
  const auto status = bench.brake.read();
  REQUIRE(status);
  CHECK(status.value().torque_Nm == Approx(167.0));
  CHECK_FALSE(status.value().tripped);
  CHECK(bench.brake.release());
  bench.world.wait_until(bench.world.now_s() + 0.02);
  CHECK_FALSE(bench.world.brake.engaged());
}

SCENARIO("a brake is released once its bus is back, and holds nothing before it is connected",
         "[hal][can][safety]") {
  Bench bench;
  REQUIRE(bench.brake.connect());
  bench.hold(100, 0.5);
  bench.is_bus_off = true;
  CHECK(bench.brake.set_torque(100).error().code == IoErrc::disconnected);
  GIVEN("a controller that is still bus-off") {
    const auto released = bench.brake.release();
    REQUIRE_FALSE(released);
    CHECK(released.error().code == IoErrc::disconnected);
    bench.world.wait_until(bench.world.now_s() + 0.02);
    CHECK(bench.world.brake.engaged());
  }
  GIVEN("one that has recovered") {
    CHECK_FALSE(bench.brake.release());
    bench.is_bus_off = false;
    CHECK_FALSE(bench.brake.set_torque(100));
    REQUIRE(bench.brake.release());
    const double released_s = bench.world.now_s();
    THEN("the brake lets go, and can be seen to") {
      const auto status = bench.brake.read();
      REQUIRE(status);
      CHECK(status.value().torque_Nm == 0);
      CHECK_FALSE(bench.world.brake.engaged());
      CHECK(bench.world.now_s() - released_s < 0.02);
    }
    THEN("no torque resumes by itself") {
      CHECK(bench.brake.set_torque(100).error().code == IoErrc::disconnected);
      REQUIRE(bench.brake.connect());
      CHECK(bench.brake.set_torque(100));
    }
    THEN("the other devices on the bus hear that it was lost") {
      const auto heard = bench.ports[0]->receive();
      REQUIRE_FALSE(heard);
      CHECK(heard.error().code == IoErrc::disconnected);
    }
  }
}

TEST_CASE("a brake that nobody has reached is not said to be released", "[hal][can][safety]") {
  Bench bench;
  CHECK_FALSE(bench.brake.release());
}

SCENARIO("a brake that hears no more commands releases, and stays released", "[hal][can]") {
  Bench bench;
  REQUIRE(bench.brake.connect());
  bench.hold(100, 0.5);
  const double last_command_s = bench.world.now_s() - 0.1;
  bench.world.wait_until(last_command_s + 0.99);
  CHECK(bench.world.brake.engaged());
  bench.world.wait_until(last_command_s + 1.01);
  CHECK_FALSE(bench.world.brake.engaged());
  WHEN("its status is read") {
    bench.world.wait_until(bench.world.now_s() + 0.02);
    THEN("it says that it is not as it should be") { CHECK(bench.brake.read().value().tripped); }
  }
  WHEN("commands come again") {
    bench.hold(100, 0.5);
    THEN("nothing resumes by itself") { CHECK_FALSE(bench.world.brake.engaged()); }
  }
  WHEN("it is connected anew") {
    REQUIRE(bench.brake.connect());
    bench.hold(100, 0.5);
    THEN("it obeys again") { CHECK(bench.world.brake.engaged()); }
  }
}

SCENARIO("a brake that misbehaves is an error, each in its own word", "[hal][can]") {
  Bench bench;
  REQUIRE(bench.brake.connect());
  bench.hold(100, 0.3);
  REQUIRE(bench.brake.read());
  const auto code_after = [&](sim::NodeFault fault) {
    bench.world.brake.set_fault(fault);
    bench.world.wait_until(bench.world.now_s() + 0.3);
    const auto status = bench.brake.read();
    REQUIRE_FALSE(status);
    return status.error().code;
  };
  SECTION("silent") { CHECK(code_after(sim::NodeFault::silent) == IoErrc::timeout); }
  SECTION("frozen") { CHECK(code_after(sim::NodeFault::frozen) == IoErrc::stale); }
  SECTION("garbled") { CHECK(code_after(sim::NodeFault::garbled) == IoErrc::bad_reply); }
  SECTION("its own trip is told, and a new connect resets it") {
    bench.world.brake.trip();
    bench.world.wait_until(bench.world.now_s() + 0.02);
    CHECK(bench.brake.read().value().tripped);
    bench.hold(100, 0.3);
    CHECK_FALSE(bench.world.brake.engaged());
    CHECK(bench.brake.connect());
  }
}

TEST_CASE("a brake's status is as old as its frame, however often it is read", "[hal][can]") {
  Bench bench;
  REQUIRE(bench.brake.connect());
  bench.world.wait_until(bench.world.now_s() + 0.1);
  bench.world.brake.set_fault(sim::NodeFault::silent);
  const double silent_s = bench.world.now_s();
  bench.world.wait_until(silent_s + 0.15);
  const auto status = bench.brake.read();
  REQUIRE(status);
  CHECK(status.value().time_s <= silent_s);
  CHECK(status.value().time_s > silent_s - 0.05);
}

SCENARIO("a brake that does not answer is found at connect", "[hal][can]") {
  Bench bench;
  bench.world.brake.set_fault(sim::NodeFault::silent);
  const auto connected = bench.brake.connect();
  REQUIRE_FALSE(connected);
  CHECK(connected.error().code == IoErrc::timeout);
  CHECK_FALSE(bench.brake.set_torque(10));
}

TEST_CASE("a brake beyond what its frames can tell is the caller's bug", "[hal][can]") {
  test::CanBench world;
  CHECK_THROWS_AS(hal::CanBrake(nullptr, {}, world), std::invalid_argument);
  CHECK_THROWS_AS(
      hal::CanBrake(std::move(world.bus.bench), {.limits = {.max_torque_Nm = 7000}}, world),
      std::invalid_argument);
}
