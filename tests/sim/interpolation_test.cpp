#include "sim/interpolation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/support/signals.hpp"

using namespace rvbench;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

double farthest_from_tone(const sim::Interpolation& at, double cycles, double fraction,
                          double gain) {
  const Eigen::VectorXd x = test::tone(cycles, 1000, 1);
  double farthest = 0;
  for (Eigen::Index i = 300; i < 700; ++i) {
    const double truth = gain * std::cos(two_pi * cycles * (double(i) + fraction));
    farthest = std::max(farthest, std::abs(at(x, i) - truth));
  }
  return farthest;
}

}  // namespace

TEST_CASE("a tone is found between its samples", "[sim][interpolation]") {
  const double fraction = GENERATE(0.0, 0.125, 0.5, 0.9);
  for (const double cycles : {0.01, 0.2, 0.39}) {
    CHECK(farthest_from_tone(sim::Interpolation(0, fraction), cycles, fraction, 1) < 1e-3);
  }
}

TEST_CASE("what lies above the band is kept out, what lies in it passes", "[sim][interpolation]") {
  const sim::Interpolation low_pass(0, 0, 0.04);
  CHECK(farthest_from_tone(low_pass, 0.02, 0, 1) < 5e-4);
  CHECK(farthest_from_tone(low_pass, 0.056, 0, 0) < 5e-4);  // 1.4 times the cut-off
  CHECK(farthest_from_tone(low_pass, 0.2, 0, 0) < 1e-4);
}

TEST_CASE("a parabola has its slope and its curvature", "[sim][interpolation]") {
  const Eigen::ArrayXd t = test::times_s(400, 1);
  const Eigen::VectorXd x = 3 + 0.5 * t + 0.25 * t.square();
  CHECK(sim::Interpolation(1, 0, 0.1)(x, 200) == Approx(0.5 + 0.5 * 200));
  CHECK(sim::Interpolation(2, 0, 0.1)(x, 200) == Approx(0.5));
  const Eigen::VectorXd constant = Eigen::VectorXd::Constant(400, 3);
  CHECK(sim::Interpolation(0, 0.3, 0.1)(constant, 200) == Approx(3));
  CHECK(sim::Interpolation(1, 0.3, 0.1)(constant, 200) == Approx(0).margin(1e-12));
  CHECK(sim::Interpolation(2, 0.3, 0.1)(constant, 200) == Approx(0).margin(1e-12));
}

TEST_CASE("a straight line goes on beyond the ends of a record", "[sim][interpolation]") {
  const Eigen::VectorXd line = 2 + 0.1 * test::times_s(50, 1);
  for (const Eigen::Index at : {0, 1, 48, 49}) {
    CHECK(sim::Interpolation(0, 0, 0.2)(line, at) == Approx(line[at]));
    CHECK(sim::Interpolation(1, 0, 0.2)(line, at) == Approx(0.1));
  }
}

TEST_CASE("an interpolation that makes no sense is refused", "[sim][interpolation]") {
  CHECK_THROWS_AS(sim::Interpolation(3, 0), std::invalid_argument);
  CHECK_THROWS_AS(sim::Interpolation(0, 1), std::invalid_argument);
  CHECK_THROWS_AS(sim::Interpolation(0, 0, 0.6), std::invalid_argument);
}
