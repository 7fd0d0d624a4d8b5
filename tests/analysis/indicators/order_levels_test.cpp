#include "analysis/indicators/order_levels.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using namespace rvbench::analysis;
using rvbench::test::RingingSpec;
using rvbench::test::tone;

namespace {

// 64 samples per turn over 20 turns: lines are 1/20 order apart.
Spectrum orders_of(const Eigen::VectorXd& x) {
  return amplitude_spectrum(x, 64, Window::rectangular);
}

}  // namespace

TEST_CASE("the level at an order is its line's, or that of the highest within reach",
          "[analysis][indicators]") {
  const Spectrum spectrum =
      orders_of(0.3 * tone(1, 1280, 64) + 0.7 * tone(1.2, 1280, 64) + 5 * tone(0, 1280, 64));
  CHECK(*level_at_order(spectrum, 1, 0) == Approx(0.3));
  CHECK(*level_at_order(spectrum, 1.01, 0.05) == Approx(0.3));
  CHECK(*level_at_order(spectrum, 1, 0.25) == Approx(0.7));
  CHECK(*level_at_order(spectrum, 3, 0.5) < 1e-12);
  CHECK(*level_at_order(spectrum, 0.05, 1.2) == Approx(0.7));  // the mean is no line
}

TEST_CASE("beyond the spectrum there is no level", "[analysis][indicators]") {
  const Spectrum spectrum = orders_of(tone(1, 1280, 64));
  CHECK_FALSE(level_at_order(spectrum, 33, 0.1));
  CHECK_FALSE(level_at_order(spectrum, 0, 0.1));
  CHECK_THROWS_AS(level_at_order(spectrum, -1, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(level_at_order(spectrum, 1, std::nan("")), std::invalid_argument);
}

TEST_CASE("a mesh that swings by m has a sideband ratio of m", "[analysis][indicators]") {
  const double m = GENERATE(0.0, 0.1, 0.8);
  const Eigen::VectorXd x =
      rvbench::test::ringing({.carrier_Hz = 9, .rate_Hz = 1, .depth = m}, 1280, 64);
  const auto ratio = sideband_ratio(orders_of(x), 9, 1);
  REQUIRE(ratio);
  CHECK(*ratio == Approx(m).margin(1e-12));
}

TEST_CASE("sidebands that are no lines of the spectrum make no ratio", "[analysis][indicators]") {
  const Spectrum spectrum = orders_of(tone(9, 1280, 64));
  CHECK_FALSE(sideband_ratio(spectrum, 9, 0.01));
  CHECK_FALSE(sideband_ratio(spectrum, 2, 1));
  CHECK_FALSE(sideband_ratio(spectrum, 31, 1));
  CHECK_FALSE(sideband_ratio(orders_of(Eigen::VectorXd::Zero(1280)), 9, 1));
}
