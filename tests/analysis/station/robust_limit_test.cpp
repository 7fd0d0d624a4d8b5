#include "analysis/station/robust_limit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "analysis/station/distributions.hpp"

using namespace rvbench::analysis;
using Catch::Matchers::Contains;

namespace {

constexpr double typical = 1, scatter = 0.1;  // of an indicator among good units

std::vector<double> good_units(std::size_t count, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(typical, scatter);
  std::vector<double> units(count);
  for (double& unit : units) unit = normal(engine);
  return units;
}

// The last three are noisy by so many standard deviations.
std::vector<double> with_three_noisy(std::vector<double> units, double deviations) {
  for (std::size_t i = units.size() - 3; i < units.size(); ++i) {
    units[i] = typical + deviations * scatter;
  }
  return units;
}

RobustLimit learnt(const std::vector<double>& units, LimitSide side = LimitSide::max) {
  static const double factor = robust_tolerance_factor(50, {});
  return std::get<RobustLimit>(robust_limit(units, side, factor));
}

double mean_and_four_sigma(const std::vector<double>& units) {
  const Eigen::Map<const Eigen::ArrayXd> x(units.data(), Eigen::Index(units.size()));
  return x.mean() + 4 * std::sqrt((x - x.mean()).square().sum() / double(x.size() - 1));
}

// By how much three noisy units widen a limit: of 200 learning sets the mean, of the limit's
// distance from a typical unit, which is the strictest one can ask.
template <typename Limit>
double widening(double deviations, const Limit& limit) {
  double clean = 0, spoilt = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<double> units = good_units(50, seed);
    clean += limit(units) - typical;
    spoilt += limit(with_three_noisy(units, deviations)) - typical;
  }
  return spoilt / clean - 1;
}

double robust(const std::vector<double>& units) { return learnt(units).limit; }

}  // namespace

TEST_CASE("three noisy units among fifty do not widen a learnt limit", "[analysis][station]") {
  const double deviations = GENERATE(5.0, 8.0, 20.0);
  CAPTURE(deviations);
  CHECK(std::abs(widening(deviations, robust)) < 0.02);
  CHECK(widening(deviations, mean_and_four_sigma) > 0.5);
}

TEST_CASE("noisy units that nobody can tell from good ones widen it by less than a tenth",
          "[analysis][station]") {
  const double deviations = GENERATE(2.5, 3.0, 3.5, 4.0);
  CAPTURE(deviations);
  CHECK(widening(deviations, robust) < 0.10);
  CHECK(widening(deviations, mean_and_four_sigma) > 0.15);
}

TEST_CASE("of 200 learning sets no limit itself is widened by a tenth", "[analysis][station]") {
  double most = 0, most_of_mean = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<double> units = good_units(50, seed), spoilt = with_three_noisy(units, 8);
    most = std::max(most, robust(spoilt) / robust(units) - 1);
    most_of_mean =
        std::max(most_of_mean, mean_and_four_sigma(spoilt) / mean_and_four_sigma(units) - 1);
  }
  CHECK(most < 0.10);
  CHECK(most_of_mean > 0.30);
}

TEST_CASE("noisy units are named", "[analysis][station]") {
  const RobustLimit limit = learnt(with_three_noisy(good_units(50, 1), 8));
  CHECK(std::ranges::includes(limit.set_aside, std::vector<std::size_t>{47, 48, 49}));
  CHECK(limit.set_aside.size() < 6);
  CHECK(limit.units == 50);
  CHECK(limit.median == Approx(typical).margin(0.06));
  CHECK(limit.mad == Approx(scatter / 1.4826).epsilon(0.3));
  CHECK(limit.limit == Approx(limit.median + limit.factor * 1.482602 * limit.mad));
}

TEST_CASE("a learnt limit holds what it promises", "[analysis][station]") {
  const std::size_t units = GENERATE(std::size_t(20), std::size_t(50), std::size_t(200));
  const Coverage coverage{0.99, 0.9};
  CAPTURE(units);
  const double factor = robust_tolerance_factor(units, coverage);
  constexpr int draws = 2000;
  int held = 0;
  for (unsigned draw = 0; draw < draws; ++draw) {
    const auto limit = robust_limit(good_units(units, 1000 + draw), LimitSide::max, factor);
    const double z = (std::get<RobustLimit>(limit).limit - typical) / scatter;
    held += normal_probability(z) >= coverage.content ? 1 : 0;
  }
  CHECK(double(held) / draws == Approx(coverage.confidence).margin(0.03));
}

TEST_CASE("more units ask for less", "[analysis][station]") {
  const double of_20 = robust_tolerance_factor(20, {}), of_100 = robust_tolerance_factor(100, {}),
               of_101 = robust_tolerance_factor(101, {}),
               of_many = robust_tolerance_factor(40000, {});
  CHECK(of_20 > of_100);
  CHECK(of_101 == Approx(of_100).epsilon(0.01));
  CHECK(of_101 < of_100);
  CHECK(of_many == Approx(normal_quantile(0.999)).epsilon(0.02));
  // It pays for the median and MAD with more than mean and s would take.
  CHECK(of_100 > one_sided_tolerance_factor(100, {}));
}

TEST_CASE("a lower limit mirrors the upper one", "[analysis][station]") {
  std::vector<double> units = good_units(50, 3);
  const RobustLimit upper = learnt(units);
  for (double& unit : units) unit = -unit;
  CHECK(learnt(units, LimitSide::min).limit == Approx(-upper.limit));
}

TEST_CASE("what cannot teach a limit says why", "[analysis][station]") {
  const auto refusal = [](const std::vector<double>& units) {
    return std::get<std::string>(robust_limit(units, LimitSide::max, 4));
  };
  CHECK(refusal(good_units(12, 1)) == "12 units, and a limit takes 20");
  CHECK(refusal({1}) == "1 unit, and a limit takes 20");
  CHECK(refusal({}) == "0 units, and a limit takes 20");
  CHECK_THAT(refusal(std::vector<double>(30, 0.5)),
             Contains("half of the 30 units have one value"));
  std::vector<double> wide(50);
  for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = i % 2 == 0 ? 1.7e308 : -1.7e308;
  CHECK_THAT(refusal(wide), Contains("cannot tell: the spread of the units is no finite"));
  for (double& value : wide) value *= 0.4;
  CHECK_THAT(refusal(wide), Contains("cannot tell: the limit is no finite number"));
  CHECK_THROWS_AS(robust_limit({std::nan("")}, LimitSide::max, 4), std::invalid_argument);
  CHECK_THROWS_WITH(robust_tolerance_factor(19, {}), Contains("19 units, and a limit takes 20"));
  CHECK_THROWS_AS(robust_tolerance_factor(20, {0.4, 0.95}), std::invalid_argument);
}
