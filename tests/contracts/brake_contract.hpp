#pragma once

#include <catch2/catch.hpp>
#include <limits>
#include <stdexcept>

#include "hal/brake.hpp"
#include "hal/clock.hpp"

namespace rvbench::test {

/// What every Brake promises (see hal/brake.hpp). Call it within a test case of its own, with a
/// brake not yet connected.
inline void check_brake_contract(hal::Brake& brake, hal::Clock& clock) {
  SECTION("before connect, calls report a dead link instead of throwing") {
    const auto status = brake.read();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == IoErrc::disconnected);
    CHECK_FALSE(status.error().where.empty());
    CHECK_FALSE(brake.set_torque(0));
  }
  SECTION("a torque beyond the limits, or a driving one, is the caller's bug") {
    REQUIRE(brake.connect());
    const double max_Nm = brake.limits().max_torque_Nm;
    REQUIRE(max_Nm > 0);
    CHECK_THROWS_AS(brake.set_torque(1.01 * max_Nm), std::invalid_argument);
    CHECK_THROWS_AS(brake.set_torque(-0.1), std::invalid_argument);
    CHECK_THROWS_AS(brake.set_torque(std::numeric_limits<double>::quiet_NaN()),
                    std::invalid_argument);
    CHECK(brake.set_torque(max_Nm));
    CHECK(brake.release());
  }
  SECTION("release is legal at any time, twice too") {
    (void)brake.release();  // nobody has reached it yet
    REQUIRE(brake.connect());
    CHECK(brake.release());
    CHECK(brake.release());
    CHECK(brake.read());
  }
  SECTION("a sound brake stays readable") {
    REQUIRE(brake.connect());
    for (int i = 0; i < 20; ++i) {
      clock.wait_until(clock.now_s() + 0.05);
      const auto status = brake.read();
      REQUIRE(status);
      CHECK_FALSE(status.value().tripped);
      CHECK_FALSE(status.value().time_s > clock.now_s());  // NaN: as of now
    }
  }
}

/// What a Brake promises beyond that if it really brakes (a replayed one does not).
inline void check_brake_obeys(hal::Brake& brake, hal::Clock& clock) {
  const auto hold = [&](double torque_Nm, double duration_s) {
    const double end_s = clock.now_s() + duration_s;
    while (clock.now_s() < end_s) {
      REQUIRE(brake.set_torque(torque_Nm));
      clock.wait_until(clock.now_s() + 0.05);
    }
  };
  const double load_Nm = 0.25 * brake.limits().max_torque_Nm;
  SECTION("it holds the torque as long as commands come") {
    REQUIRE(brake.connect());
    hold(load_Nm, 5);
    CHECK(brake.read().value().torque_Nm == Approx(load_Nm).epsilon(0.02));
  }
  SECTION("it releases on command, and connect leaves it released") {
    REQUIRE(brake.connect());
    hold(load_Nm, 2);
    CHECK(brake.release());
    clock.wait_until(clock.now_s() + 2);
    CHECK(brake.read().value().torque_Nm == Approx(0).margin(0.02 * load_Nm));
    hold(load_Nm, 2);
    REQUIRE(brake.connect());
    clock.wait_until(clock.now_s() + 2);
    CHECK(brake.read().value().torque_Nm == Approx(0).margin(0.02 * load_Nm));
  }
  SECTION("it releases by itself when commands stop coming") {
    REQUIRE(brake.connect());
    hold(load_Nm, 2);
    clock.wait_until(clock.now_s() + 5);
    CHECK(brake.read().value().torque_Nm == Approx(0).margin(0.02 * load_Nm));
  }
}

}  // namespace rvbench::test
