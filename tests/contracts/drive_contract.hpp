#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "hal/clock.hpp"
#include "hal/drive.hpp"

namespace rvbench::test {

/// What every Drive promises (see hal/drive.hpp). Call it within a test case of its own, with a
/// drive not yet connected.
inline void check_drive_contract(hal::Drive& drive) {
  SECTION("before connect, calls report a dead link instead of throwing") {
    const auto status = drive.read();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == IoErrc::disconnected);
    CHECK_FALSE(status.error().where.empty());
    CHECK_FALSE(drive.set_speed(0));
    CHECK_FALSE(drive.read_watchdog());
  }
  SECTION("a speed beyond the limits, or none at all, is the caller's bug") {
    REQUIRE(drive.connect());
    const double max_rpm = drive.limits().max_speed_rpm;
    REQUIRE(max_rpm > 0);
    CHECK_THROWS_AS(drive.set_speed(1.01 * max_rpm), std::invalid_argument);
    CHECK_THROWS_AS(drive.set_speed(-1.01 * max_rpm), std::invalid_argument);
    CHECK_THROWS_AS(drive.set_speed(std::numeric_limits<double>::quiet_NaN()),
                    std::invalid_argument);
    CHECK(drive.set_speed(max_rpm));
    drive.stop();
  }
  SECTION("stop is legal at any time, twice too") {
    drive.stop();
    REQUIRE(drive.connect());
    drive.stop();
    drive.stop();
    CHECK(drive.read());
  }
  SECTION("connect is legal again; a sound link needs no retries") {
    REQUIRE(drive.connect());
    REQUIRE(drive.connect());
    CHECK(drive.read());
    CHECK(drive.read_watchdog());
    CHECK(drive.retries() == 0);
  }
}

/// What a Drive promises beyond that if there is a shaft that obeys it (a replayed one does not).
/// @param within_s  how long a change of speed may take
inline void check_drive_obeys(hal::Drive& drive, hal::Clock& clock, double within_s) {
  const auto speed_after = [&](double speed_rpm) {
    const double end_s = clock.now_s() + within_s;
    while (clock.now_s() < end_s) {
      REQUIRE(drive.set_speed(speed_rpm));
      clock.wait_until(clock.now_s() + 0.1);
    }
    const auto status = drive.read();
    REQUIRE(status);
    return status.value().speed_rpm;
  };
  SECTION("the shaft follows in both directions, and connect alone moves nothing") {
    REQUIRE(drive.connect());
    clock.wait_until(clock.now_s() + 0.5);
    CHECK(drive.read().value().speed_rpm == Approx(0).margin(1));
    CHECK(speed_after(300) == Approx(300).epsilon(0.1));
    CHECK(speed_after(-300) == Approx(-300).epsilon(0.1));
  }
  SECTION("stop brings it to standstill, and nothing resumes by itself") {
    REQUIRE(drive.connect());
    CHECK(speed_after(300) == Approx(300).epsilon(0.1));
    drive.stop();
    clock.wait_until(clock.now_s() + within_s);
    CHECK(drive.read().value().speed_rpm == Approx(0).margin(1));
    clock.wait_until(clock.now_s() + within_s);
    CHECK(drive.read().value().speed_rpm == Approx(0).margin(1));
    CHECK_FALSE(drive.read().value().tripped);
  }
}

}  // namespace rvbench::test
