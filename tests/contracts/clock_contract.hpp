#pragma once

#include <catch2/catch.hpp>

#include "hal/clock.hpp"

namespace rvbench::test {

/// What every Clock promises (see hal/clock.hpp). Call it within a test case of its own.
inline void check_clock_contract(hal::Clock& clock) {
  SECTION("it arrives where it was asked to wait for") {
    const double start_s = clock.now_s();
    CHECK(start_s >= 0);
    clock.wait_until(start_s + 0.02);
    CHECK(clock.now_s() >= start_s + 0.02 - 1e-9);
    if (clock.is_virtual()) CHECK(clock.now_s() == Approx(start_s + 0.02).margin(1e-3));
  }
  SECTION("it never goes back") {
    clock.wait_until(clock.now_s() + 0.02);
    const double reached_s = clock.now_s();
    clock.wait_until(reached_s - 0.01);
    CHECK(clock.now_s() >= reached_s);
    clock.wait_until(-1);
    CHECK(clock.now_s() >= reached_s);
  }
  SECTION("a virtual clock stands still unless asked to move") {
    if (!clock.is_virtual()) return;
    const double now_s = clock.now_s();
    CHECK(clock.now_s() == now_s);
    clock.wait_until(now_s);
    CHECK(clock.now_s() == now_s);
  }
}

}  // namespace rvbench::test
