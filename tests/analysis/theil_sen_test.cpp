#include "analysis/theil_sen.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace rvbench::analysis {
namespace {

std::vector<double> counted(std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = double(i);
  return x;
}

// White noise, or such that each value keeps a share of the one before it.
std::vector<double> noise(std::size_t n, unsigned seed, double kept = 0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<double> y(n);
  for (std::size_t i = 0; i < n; ++i) y[i] = normal(generator) + (i > 0 ? kept * y[i - 1] : 0);
  return y;
}

double share_told(std::size_t n, double kept) {
  int told = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    if (theil_sen(counted(n), noise(n, seed, kept)).is_told()) ++told;
  }
  return told / 400.0;
}

}  // namespace

TEST_CASE("a straight line is its own slope, and its interval has no width", "[analysis][trend]") {
  const auto x = counted(12);
  std::vector<double> y;
  for (const double t : x) y.push_back(3 - 0.5 * t);
  const SlopeOverTime line = theil_sen(x, y);
  CHECK(line.slope == Approx(-0.5));
  CHECK(line.low == Approx(-0.5));
  CHECK(line.high == Approx(-0.5));
  CHECK(line.level == Approx(3 - 0.5 * 5.5));
  CHECK(line.is_told());
}

TEST_CASE("a quarter of gross outliers does not move the slope", "[analysis][trend]") {
  const auto x = counted(40);
  std::vector<double> y;
  for (const double t : x) y.push_back(0.1 * t + (int(t) % 4 == 1 ? 1000 : 0));
  CHECK(theil_sen(x, y).slope == Approx(0.1).margin(0.02));
}

TEST_CASE("the ranks of the interval are those of Sen's variance", "[analysis][trend]") {
  // Ten distinct values that alternate: Var S = 10·9·25/18 = 125, C = 1.96·√125 = 21.9 of 45
  // slopes: ranks 11.5 and 33.5 + 1, taken outward 11 and 35.
  const auto x = counted(10);
  std::vector<double> y, slopes;
  for (int i = 0; i < 10; ++i) {
    y.push_back(i % 2 == 0 ? i + 10 : i - 10);
    for (int j = 0; j < i; ++j) {
      slopes.push_back((y[std::size_t(i)] - y[std::size_t(j)]) / (i - j));
    }
  }
  std::sort(slopes.begin(), slopes.end());
  const SlopeOverTime line = theil_sen(x, y);
  CHECK(line.slope == Approx(slopes[22]));
  REQUIRE(line.dependence == 1);
  CHECK(line.low == Approx(slopes[10]));
  CHECK(line.high == Approx(slopes[34]));
}

TEST_CASE("noise alone is told as a trend as seldom as the interval says", "[analysis][trend]") {
  CHECK(share_told(30, 0) == Approx(0.05).margin(0.03));  // 400 draws: ± 0.022 by 2 sigma
  // Neighbours that are alike would be told in one case of three by the plain interval.
  CHECK(share_told(60, 0.5) < 0.15);
}

TEST_CASE("a slope is found where it stands out of the noise", "[analysis][trend]") {
  const auto x = counted(50);
  auto y = noise(50, 7);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += 0.2 * x[i];
  const SlopeOverTime line = theil_sen(x, y);
  CHECK(line.is_told());
  CHECK(line.low < 0.2);
  CHECK(line.high > 0.2);
}

TEST_CASE("what has no slope is refused, and constant values have none to tell",
          "[analysis][trend]") {
  CHECK_FALSE(theil_sen(counted(10), std::vector<double>(10, 4.0)).is_told());
  CHECK_THROWS_AS(theil_sen(counted(9), counted(9)), std::invalid_argument);
  CHECK_THROWS_AS(theil_sen(counted(10), counted(11)), std::invalid_argument);
  CHECK_THROWS_AS(theil_sen(std::vector<double>(10, 1.0), counted(10)), std::invalid_argument);
  auto y = counted(10);
  y[3] = NAN;
  CHECK_THROWS_AS(theil_sen(counted(10), y), std::invalid_argument);
}

}  // namespace rvbench::analysis
