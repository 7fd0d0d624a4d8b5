#include "analysis/quality/drift.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::find_drift;

namespace {

constexpr double rate_Hz = 1000;
constexpr Eigen::Index count = 20000;

// Noise of equal power per octave: poles an octave apart in cutoff, of equal power each.
Eigen::VectorXd pink(Eigen::Index n, unsigned seed) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
  for (int octave = 0; octave < 20; ++octave) {
    const double a = std::exp(-3.0 * std::pow(2.0, -octave));
    const Eigen::VectorXd white = test::white_noise(n, seed + 100u * unsigned(octave));
    double state = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      state = a * state + std::sqrt(1 - a * a) * white[i];
      sum[i] += state;
    }
  }
  return sum;
}

Eigen::VectorXd ramp(double change) {
  return change * test::times_s(count, rate_Hz) / (double(count) / rate_Hz);
}

}  // namespace

TEST_CASE("a mean that moves by more than ten times the vibration drifts", "[analysis][quality]") {
  const Eigen::VectorXd vibration = test::white_noise(count, 1);
  CHECK_FALSE(find_drift(vibration, rate_Hz, 0.1));
  CHECK_FALSE(find_drift(vibration + ramp(9), rate_Hz, 0.1));
  const auto drift = find_drift(vibration - ramp(12), rate_Hz, 0.1);
  REQUIRE(drift);
  CHECK(drift->change == Approx(12 * 0.95).epsilon(0.02));  // from the middle of the first second
  CHECK(drift->vibration == Approx(1).epsilon(0.05));
}

TEST_CASE("a supply that settles drifts until it has", "[analysis][quality]") {
  const Eigen::VectorXd settling = 40 * (-test::times_s(count, rate_Hz) / 1.5).exp();
  CHECK(find_drift(test::white_noise(count, 2) + settling, rate_Hz, 0.1));
}

TEST_CASE("an offset, and the gravity that a turning sensor feels, are no drift",
          "[analysis][quality]") {
  const Eigen::VectorXd vibration = 0.05 * test::white_noise(count, 3);
  CHECK_FALSE(find_drift(vibration.array() + 300, rate_Hz, 0.1));
  const double period_s = 4.5;
  const Eigen::VectorXd gravity = 9.81 * test::tone(1 / period_s, count, rate_Hz);
  CHECK_FALSE(find_drift(vibration + gravity, rate_Hz, period_s));
}

TEST_CASE("pink noise is no drift, whatever the length", "[analysis][quality]") {
  const unsigned seed = GENERATE(1u, 2u, 3u);
  CHECK_FALSE(find_drift(pink(count, seed), rate_Hz, 0.1));
  CHECK_FALSE(find_drift(pink(600000, seed), rate_Hz, 0.1));
}

TEST_CASE("a record of less than four blocks cannot tell", "[analysis][quality]") {
  const Eigen::VectorXd x = test::white_noise(count, 4) + ramp(100);
  CHECK_FALSE(find_drift(x, rate_Hz, 5.1));
  CHECK(find_drift(x, rate_Hz, 5.0));
  CHECK_FALSE(find_drift(x.head(3900), rate_Hz, 0.1));
}

TEST_CASE("drift is not asked of nonsense", "[analysis][quality]") {
  const Eigen::VectorXd x = test::white_noise(100, 5);
  CHECK_THROWS_AS(find_drift(x, 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(find_drift(x, 10, 0), std::invalid_argument);
  CHECK_THROWS_AS(find_drift(x * std::nan(""), 10, 1), std::invalid_argument);
}
