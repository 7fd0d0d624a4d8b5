#include "analysis/indicators/gear_condition.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using namespace rvbench::analysis;
using rvbench::test::tone;
using rvbench::test::white_noise;

namespace {

constexpr Eigen::Index samples = 1024;  // over one turn of a gear of 23 teeth
constexpr Eigen::Index teeth = 23;

Eigen::VectorXd of_order(double order) { return tone(order, samples, samples); }

}  // namespace

TEST_CASE("FM0 of a mesh that is one sine is 2", "[analysis][indicators]") {
  const auto value = fm0(7 * of_order(16), 16, 3);
  REQUIRE(value);
  CHECK(*value == Approx(2));
}

TEST_CASE("FM0 counts all harmonics of the mesh, and what rises above them",
          "[analysis][indicators]") {
  // Two cosines in phase range from their sum to where 2 + 4·cos is 0: cos(a) + cos(2a)/2 is least
  // at cos(a) = -1/2.
  const Eigen::VectorXd mesh = of_order(16) + 0.5 * of_order(32);
  CHECK(*fm0(mesh, 16, 2) == Approx((1.5 + 0.75) / 1.5).epsilon(1e-3));
  Eigen::VectorXd struck = of_order(teeth);
  struck[0] += 4;
  const double line = 1 + 2 * 4.0 / samples;  // of the strike's own spectrum
  CHECK(*fm0(struck, teeth, 1) == Approx((5 - of_order(teeth).minCoeff()) / line).epsilon(1e-9));
}

TEST_CASE("a gear without mesh has no FM0, a mesh beyond the record throws",
          "[analysis][indicators]") {
  CHECK_FALSE(fm0(Eigen::VectorXd::Zero(samples), teeth, 3));
  CHECK_FALSE(fm0(of_order(5), teeth, 3));
  CHECK_THROWS_AS(fm0(of_order(teeth), teeth, 23), std::invalid_argument);
  CHECK_THROWS_AS(fm0(of_order(teeth), 0, 1), std::invalid_argument);
}

TEST_CASE("FM4 is 3 for noise, and grows with a tooth that stands out", "[analysis][indicators]") {
  Eigen::VectorXd difference = white_noise(100000, 1);
  CHECK(fm4(difference) == Approx(3).margin(4 * std::sqrt(24.0 / 100000)));
  difference[500] += 60;
  CHECK(fm4(difference) > 50);
  CHECK(fm4(Eigen::VectorXd::Zero(10)) == 0);
}

TEST_CASE("NA4 is FM4 at first, and grows as all teeth get worse, which FM4 does not see",
          "[analysis][indicators]") {
  const Eigen::VectorXd sound = white_noise(10000, 1);
  const Eigen::VectorXd worn = 2 * sound;
  const double variance = (sound.array() - sound.mean()).square().mean();
  CHECK(*na4(residual_moments(sound), {}) == Approx(fm4(sound)));
  CHECK(fm4(worn) == Approx(fm4(sound)));
  // Nine records of variance 1 and one of 4: 16 times the fourth moment over 1.3².
  const std::vector<double> nine(9, variance);
  CHECK(*na4(residual_moments(worn), nine) == Approx(16 / (1.3 * 1.3) * fm4(sound)));
  // A gear that stays as it is stays at 3.
  CHECK(*na4(residual_moments(sound), nine) == Approx(fm4(sound)));
}

TEST_CASE("what never swung has no NA4, moments that are none throw", "[analysis][indicators]") {
  CHECK_FALSE(na4(residual_moments(Eigen::VectorXd::Constant(10, 2)), {0, 0, 0}));
  CHECK_THROWS_AS(residual_moments(Eigen::VectorXd()), std::invalid_argument);
  CHECK_THROWS_AS(na4({1, 3}, {-1}), std::invalid_argument);
  CHECK_THROWS_AS(na4({1, -3}, {}), std::invalid_argument);
}
