#include <catch2/catch.hpp>

#include "hal/steady_clock.hpp"
#include "hal/stepped_clock.hpp"

using namespace rvbench::hal;

TEST_CASE("a stepped clock moves only when it is waited for", "[hal][clock]") {
  SteppedClock clock;
  CHECK(clock.now_s() == 0);
  clock.wait_until(3600);
  CHECK(clock.now_s() == 3600);
  clock.wait_until(10);  // has passed
  CHECK(clock.now_s() == 3600);
  CHECK(clock.is_virtual());
}

TEST_CASE("a steady clock never returns from a wait too early", "[hal][clock]") {
  SteadyClock clock;
  CHECK(clock.now_s() >= 0);
  for (const double ahead_s : {1e-4, 1e-3, 3e-3}) {
    const double until_s = clock.now_s() + ahead_s;
    clock.wait_until(until_s);
    CHECK(clock.now_s() >= until_s);
  }
  const double before_s = clock.now_s();
  clock.wait_until(before_s - 1);
  CHECK(clock.now_s() >= before_s);
  CHECK_FALSE(clock.is_virtual());
}
