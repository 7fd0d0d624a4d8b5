#include "analysis/squared_envelope.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace rvbench::analysis;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rate_Hz = 8000;

Eigen::VectorXd noise(Eigen::Index size, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(size, [&] { return normal(engine); });
}

}  // namespace

TEST_CASE("a carrier that swells by m shows 2m at its swell's frequency and m²/2 at twice that",
          "[analysis]") {
  constexpr double m = 0.3;
  Eigen::VectorXd x(8000);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double t_s = double(i) / rate_Hz;
    x[i] = (1 + m * std::cos(2 * pi * 40 * t_s)) * std::sin(2 * pi * 1000 * t_s);
  }
  const BandVibration shown = band_vibration(x, rate_Hz, 500, 1500, 2);
  const double mean = 1 + m * m / 2;
  CHECK(shown.depth.amplitude[40] == Approx(2 * m / mean).epsilon(1e-6));
  CHECK(shown.depth.amplitude[80] == Approx(m * m / 2 / mean).epsilon(1e-6));
  CHECK(shown.mean_square.sum() == Approx(mean / 2).epsilon(1e-9));
}

TEST_CASE("levels of white noise are its power by the width of each part", "[analysis]") {
  const BandVibration shown = band_vibration(noise(400000, 1), rate_Hz, 1000, 3000, 5);
  for (const double power : shown.mean_square) CHECK(power == Approx(0.1).epsilon(0.02));
}

TEST_CASE("of noise alone the largest depth near a frequency is what noise would show",
          "[analysis]") {
  double seen = 0, told = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const BandVibration shown = band_vibration(noise(16000, seed), rate_Hz, 500, 3500, 1);
    const DepthNear near = depth_near(shown.depth, 160, 4);
    seen += near.depth * near.depth / 40;
    told += near.noise * near.noise / 40;
  }
  CHECK(std::sqrt(seen / told) == Approx(1).margin(0.15));
}

TEST_CASE("a band that the rate does not hold throws, as do samples that are none", "[analysis]") {
  CHECK_THROWS_AS(band_vibration(noise(100, 1), rate_Hz, 500, 5000, 1), std::invalid_argument);
  CHECK_THROWS_AS(band_vibration(noise(3, 1), rate_Hz, 500, 1000, 1), std::invalid_argument);
  Eigen::VectorXd gap = noise(100, 1);
  gap[7] = std::nan("");
  CHECK_THROWS_AS(band_vibration(gap, rate_Hz, 500, 1000, 1), std::invalid_argument);
}
