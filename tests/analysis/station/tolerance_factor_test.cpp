#include "analysis/station/tolerance_factor.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "analysis/station/distributions.hpp"

using namespace rvbench::analysis;

namespace {

struct SampleOfNormals {
  double mean = 0, deviation = 0;
};

SampleOfNormals drawn(std::size_t units, std::mt19937& engine) {
  std::normal_distribution<double> normal;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < units; ++i) {
    const double value = normal(engine);
    sum += value;
    squares += value * value;
  }
  const auto n = double(units);
  return {sum / n, std::sqrt((squares - sum * sum / n) / (n - 1))};
}

}  // namespace

TEST_CASE("one-sided factors are those of the tables", "[analysis][station][literature]") {
  // Natrella, Experimental Statistics, NBS Handbook 91 (1963), table A-7, confidence 0.95.
  struct Row {
    std::size_t units;
    double content, k;
  };
  const auto row = GENERATE(Row{3, 0.95, 7.655}, Row{4, 0.95, 5.145}, Row{5, 0.95, 4.202},
                            Row{6, 0.95, 3.707}, Row{10, 0.95, 2.911}, Row{20, 0.95, 2.396},
                            Row{50, 0.95, 2.065}, Row{10, 0.99, 3.981}, Row{20, 0.99, 3.295});
  CAPTURE(row.units, row.content);
  CHECK(one_sided_tolerance_factor(row.units, {row.content, 0.95}) == Approx(row.k).margin(0.0015));
}

TEST_CASE("two-sided factors are those of the tables", "[analysis][station][literature]") {
  // Berthouex & Brown, Statistics for Environmental Engineers (2002), table 21.1, confidence 0.95.
  struct Row {
    std::size_t units;
    double content, k;
  };
  const auto row =
      GENERATE(Row{5, 0.95, 5.08}, Row{10, 0.95, 3.39}, Row{20, 0.95, 2.76}, Row{30, 0.95, 2.55},
               Row{10, 0.90, 2.86}, Row{10, 0.99, 4.44}, Row{60, 0.99, 3.07});
  CAPTURE(row.units, row.content);
  CHECK(two_sided_tolerance_factor(row.units, {row.content, 0.95}) == Approx(row.k).margin(0.0101));
}

TEST_CASE("limits hold what they promise as often as they promise it", "[analysis][station]") {
  const std::size_t units = GENERATE(std::size_t(5), std::size_t(30));
  const Coverage coverage{0.99, GENERATE(0.9, 0.5)};
  CAPTURE(units, coverage.confidence);
  const double one = one_sided_tolerance_factor(units, coverage);
  const double two = two_sided_tolerance_factor(units, coverage);
  constexpr int draws = 4000;
  int one_held = 0, two_held = 0;
  std::mt19937 engine(7);
  for (int draw = 0; draw < draws; ++draw) {
    const SampleOfNormals s = drawn(units, engine);
    one_held += normal_probability(s.mean + one * s.deviation) >= coverage.content ? 1 : 0;
    two_held += normal_probability(s.mean + two * s.deviation) -
                            normal_probability(s.mean - two * s.deviation) >=
                        coverage.content
                    ? 1
                    : 0;
  }
  const double give = 4 * std::sqrt(coverage.confidence * (1 - coverage.confidence) / draws);
  CHECK(double(one_held) / draws == Approx(coverage.confidence).margin(give));
  CHECK(double(two_held) / draws == Approx(coverage.confidence).margin(give));
}

TEST_CASE("of a population that is known well the factor is the quantile", "[analysis][station]") {
  CHECK(one_sided_tolerance_factor(1000000, {0.999, 0.95}) == Approx(3.0902).epsilon(2e-3));
  CHECK(two_sided_tolerance_factor(1000000, {0.95, 0.95}) == Approx(1.96).epsilon(2e-3));
}

TEST_CASE("a factor of one unit, or of no share, does not exist", "[analysis][station]") {
  CHECK_THROWS_AS(one_sided_tolerance_factor(1, {}), std::invalid_argument);
  CHECK_THROWS_AS(two_sided_tolerance_factor(1, {}), std::invalid_argument);
  CHECK_THROWS_AS(one_sided_tolerance_factor(9, {1, 0.95}), std::invalid_argument);
  CHECK_THROWS_AS(two_sided_tolerance_factor(9, {0.9, 0}), std::invalid_argument);
}
