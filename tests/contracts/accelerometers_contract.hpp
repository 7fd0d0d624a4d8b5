#pragma once

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/accelerometers.hpp"
#include "hal/clock.hpp"

namespace rvbench::test {

// Part of check_accelerometers_contract().
inline void check_scans(hal::Accelerometers& device, hal::Clock& clock, double late_s) {
  SECTION("scans come at the rate promised, in one row without gaps or repeats") {
    REQUIRE(device.connect());
    REQUIRE(device.start());
    const double rate_Hz = device.rate_Hz();
    const double start_s = clock.now_s();
    double scans = 0;
    double due_s = -1;
    for (int i = 0; i < 10; ++i) {
      clock.wait_until(clock.now_s() + 0.04);
      const auto read = device.read();
      REQUIRE(read);
      const hal::AccelerationBlock& block = read.value();
      if (block.scans.rows() == 0) continue;
      CHECK(block.scans.cols() == static_cast<Eigen::Index>(device.channels().size()));
      if (due_s >= 0) CHECK(block.t0_s == Approx(due_s).margin(1.01 / rate_Hz));
      due_s = block.t0_s + static_cast<double>(block.scans.rows()) / rate_Hz;
      scans += static_cast<double>(block.scans.rows());
    }
    CHECK(scans == Approx((clock.now_s() - start_s) * rate_Hz).margin(2 + late_s * rate_Hz));
  }
  SECTION("it does not wait: read again at once is an empty block, no error") {
    REQUIRE(device.connect());
    REQUIRE(device.start());
    clock.wait_until(clock.now_s() + 0.1);
    REQUIRE(device.read());
    const double before_s = clock.now_s();
    const auto again = device.read();
    REQUIRE(again);
    if (clock.is_virtual()) CHECK(again.value().scans.rows() == 0);
    CHECK(clock.now_s() - before_s < 0.01);
  }
}

/// What all Accelerometers promise (see hal/accelerometers.hpp). Call it within a test case of its
/// own, with a device not yet connected and half a second of scans to come.
/// @param late_s  how long scans may be on their way: real devices send them in blocks
inline void check_accelerometers_contract(hal::Accelerometers& device, hal::Clock& clock,
                                          double late_s = 0) {
  SECTION("before start, read reports a dead link instead of throwing") {
    const auto before_connect = device.read();
    REQUIRE_FALSE(before_connect);
    CHECK(before_connect.error().code == IoErrc::disconnected);
    CHECK_FALSE(before_connect.error().where.empty());
    REQUIRE(device.connect());
    CHECK_FALSE(device.read());
  }
  SECTION("what it measures is known before the first scan") {
    REQUIRE(device.connect());
    CHECK(device.rate_Hz() > 0);
    CHECK(device.range_m_s2() > 0);
    REQUIRE_FALSE(device.channels().empty());
    for (const ChannelInfo& channel : device.channels()) {
      CHECK_FALSE(channel.name.empty());
      CHECK(channel.unit == "m/s²");
    }
  }
  check_scans(device, clock, late_s);
  SECTION("stop is legal at any time, twice too; start goes on afterwards") {
    device.stop();
    REQUIRE(device.connect());
    REQUIRE(device.start());
    device.stop();
    device.stop();
    CHECK_FALSE(device.read());
    REQUIRE(device.start());
    clock.wait_until(clock.now_s() + 0.1);
    CHECK(device.read());
  }
}

}  // namespace rvbench::test
