#include "analysis/compare/line_level.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/signals.hpp"

namespace rvbench::analysis {
namespace {

constexpr double rate = 64;  // per turn
constexpr Eigen::Index count = 64 * 64;

LineLevel level_of(const Eigen::VectorXd& x, double order, double within = 0) {
  const Spectrum spectrum = amplitude_spectrum(x, rate, Window::hann);
  return line_level(spectrum, line_floor(spectrum, 0), 1, order, within).value();
}

}  // namespace

TEST_CASE("the level of a tone on a line is its amplitude squared", "[analysis]") {
  const Eigen::VectorXd x =
      3 * test::tone(5, count, rate, 0.7) + 0.001 * test::white_noise(count, 1);
  const LineLevel level = level_of(x, 5);
  CHECK(level.power == Approx(9).epsilon(1e-3));
  CHECK(level.p_value < 1e-12);
}

TEST_CASE("between two lines a tone reads at most 0.4 dB less", "[analysis]") {
  const double between = 5 + 0.5 / 64;
  const Eigen::VectorXd x = test::tone(between, count, rate) + 0.001 * test::white_noise(count, 1);
  const double off_dB = 10 * std::log10(level_of(x, between, 1.0 / 64).power);
  CHECK(off_dB > -0.45);
  CHECK(off_dB < 0);
}

TEST_CASE("a tone that strays is found within reach, and not beyond", "[analysis]") {
  const Eigen::VectorXd x = test::tone(5.25, count, rate) + 0.1 * test::white_noise(count, 1);
  CHECK(level_of(x, 5, 0.3).power == Approx(1).epsilon(0.05));
  CHECK(level_of(x, 5, 0.1).power < 0.01);
}

TEST_CASE("noise shows no line more often than its p-value says", "[analysis]") {
  int seen = 0;
  constexpr int draws = 2000;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const LineLevel level = level_of(test::white_noise(1024, seed), 8);
    seen += level.p_value <= 0.05 ? 1 : 0;
  }
  CHECK(seen < 0.05 * draws + 3 * std::sqrt(0.05 * draws));
}

TEST_CASE("a resonance within reach is no line, a tone on it is", "[analysis]") {
  // Two poles at order 5, as wide as 96 lines: noise rings there 20 dB above what is around.
  constexpr double radius = 1 - 96 * std::numbers::pi / (64 * 64);
  const double turn = 2 * std::numbers::pi * 5 / rate;
  int called = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Eigen::VectorXd x = test::white_noise(count, seed);
    for (Eigen::Index i = 2; i < x.size(); ++i) {
      x[i] += 2 * radius * std::cos(turn) * x[i - 1] - radius * radius * x[i - 2];
    }
    called += level_of(x, 4.9, 0.3).p_value <= 1e-4 ? 1 : 0;
    x += 5 * test::rms(x) * test::tone(5.1, count, rate);
    REQUIRE(level_of(x, 4.9, 0.3).p_value < 1e-6);
  }
  CHECK(called <= 3);
}

TEST_CASE("where a spectrum does not reach there is no level", "[analysis]") {
  const Spectrum spectrum = amplitude_spectrum(test::white_noise(count, 1), rate, Window::hann);
  const LineFloor floor = line_floor(spectrum, 0);
  CHECK_FALSE(line_level(spectrum, floor, 1, 33, 0));
  CHECK_FALSE(line_level(spectrum, floor, 1, 1.0 / 64, 0));  // what is left of the mean
  CHECK(line_level(spectrum, floor, 1, 31, 0));
}

TEST_CASE("of a whole number of turns a single line is a tone's power", "[analysis]") {
  const Spectrum spectrum =
      amplitude_spectrum(2 * test::tone(5, count, rate, 0.3), rate, Window::rectangular);
  CHECK(single_line_power(spectrum, 5, 0).value() == Approx(4));
  CHECK(single_line_power(spectrum, 6, 0).value() < 1e-20);
}

}  // namespace rvbench::analysis
