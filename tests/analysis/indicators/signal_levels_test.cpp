#include "analysis/indicators/signal_levels.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using namespace rvbench::analysis;
using rvbench::test::tone;
using rvbench::test::white_noise;

TEST_CASE("a sine has a crest factor of √2 and a kurtosis of 1.5", "[analysis][indicators]") {
  const SignalLevels levels = signal_levels(3 * tone(50, 8000, 8000).array() + 20);
  CHECK(levels.rms == Approx(3 / std::sqrt(2)));
  CHECK(levels.peak == Approx(3));
  CHECK(levels.crest_factor == Approx(std::sqrt(2)));
  CHECK(levels.kurtosis == Approx(1.5));
}

TEST_CASE("one strike in n samples has a crest factor of √(n - 1) and a kurtosis of about n",
          "[analysis][indicators]") {
  constexpr double n = 1000;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(1000);
  x[17] = 8;
  const SignalLevels levels = signal_levels(x);
  CHECK(levels.rms == Approx(8 * std::sqrt((n - 1) / (n * n))));
  CHECK(levels.crest_factor == Approx(std::sqrt(n - 1)));
  CHECK(levels.kurtosis == Approx(n - 2 + 1 / (n - 1)));  // of a coin that falls once in n
}

TEST_CASE("noise has a kurtosis of 3, and its unit scales rms and peak alone",
          "[analysis][indicators]") {
  const Eigen::VectorXd x = white_noise(100000, 1);
  const SignalLevels levels = signal_levels(x);
  CHECK(levels.rms == Approx(1).epsilon(4 / std::sqrt(2 * 100000)));
  CHECK(levels.kurtosis == Approx(3).margin(4 * std::sqrt(24.0 / 100000)));
  const SignalLevels in_g = signal_levels(x / 9.80665);
  CHECK(in_g.rms == Approx(levels.rms / 9.80665));
  CHECK(in_g.crest_factor == Approx(levels.crest_factor));
  CHECK(in_g.kurtosis == Approx(levels.kurtosis));
}

TEST_CASE("silence has no crest, what is not finite throws", "[analysis][indicators]") {
  const SignalLevels levels = signal_levels(Eigen::VectorXd::Constant(10, 3));
  CHECK(levels.rms == 0);
  CHECK(levels.crest_factor == 0);
  CHECK(levels.kurtosis == 0);
  CHECK_THROWS_AS(signal_levels(Eigen::VectorXd()), std::invalid_argument);
  CHECK_THROWS_AS(signal_levels(Eigen::VectorXd::Constant(3, std::nan(""))), std::invalid_argument);
}
