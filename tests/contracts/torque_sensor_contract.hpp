#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "hal/clock.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::test {

// Part of check_torque_sensor_contract().
inline void check_samples(hal::TorqueSensor& sensor, hal::Clock& clock) {
  SECTION("samples come at the rate promised, in one row without gaps or repeats") {
    REQUIRE(sensor.connect());
    const double rate_Hz = sensor.rate_Hz();
    REQUIRE(rate_Hz > 0);
    (void)sensor.read();
    const double start_s = clock.now_s();
    double samples = 0;
    double due_s = -1;
    for (int i = 0; i < 10; ++i) {
      clock.wait_until(clock.now_s() + 0.04);
      const auto read = sensor.read();
      REQUIRE(read);
      const hal::TorqueBlock& block = read.value();
      if (block.samples.empty()) continue;
      if (due_s >= 0) CHECK(block.t0_s == Approx(due_s).margin(1.01 / rate_Hz));
      due_s = block.t0_s + static_cast<double>(block.samples.size()) / rate_Hz;
      CHECK(due_s <= clock.now_s() + 1.01 / rate_Hz);
      samples += static_cast<double>(block.samples.size());
    }
    CHECK(samples == Approx((clock.now_s() - start_s) * rate_Hz).margin(2));
  }
}

/// What every TorqueSensor promises (see hal/torque_sensor.hpp). Call it within a test case of its
/// own, with a sensor not yet connected and half a second of samples to come.
inline void check_torque_sensor_contract(hal::TorqueSensor& sensor, hal::Clock& clock) {
  SECTION("before connect, read reports a dead link instead of throwing") {
    const auto block = sensor.read();
    REQUIRE_FALSE(block);
    CHECK(block.error().code == IoErrc::disconnected);
    CHECK_FALSE(block.error().where.empty());
  }
  check_samples(sensor, clock);
  SECTION("it does not wait: read again at once is an empty block, no error") {
    REQUIRE(sensor.connect());
    clock.wait_until(clock.now_s() + 0.1);
    REQUIRE(sensor.read());
    const double before_s = clock.now_s();
    const auto again = sensor.read();
    REQUIRE(again);
    if (clock.is_virtual()) CHECK(again.value().samples.empty());
    CHECK(clock.now_s() - before_s < 0.01);
  }
  SECTION("what was lost is NaN and counted, nothing else is") {
    REQUIRE(sensor.connect());
    clock.wait_until(clock.now_s() + 0.1);
    const auto read = sensor.read();
    REQUIRE(read);
    const auto& samples = read.value().samples;
    const auto lost = std::count_if(samples.begin(), samples.end(),
                                    [](const auto& s) { return std::isnan(s.torque_Nm); });
    CHECK(lost == read.value().lost);
  }
}

}  // namespace rvbench::test
