#include "analysis/station/capability.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/station/normality.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/told.hpp"

using namespace rvbench;
using analysis::Capability;
using analysis::capability_of;
using analysis::normality_p_value;
using test::told;

namespace {

// n values of exactly this mean and standard deviation.
Eigen::VectorXd of_mean_and_s(Eigen::Index n, double mean, double s) {
  Eigen::ArrayXd x = test::white_noise(n, 4).array();
  x -= x.mean();
  return mean + s * x / std::sqrt(x.square().sum() / double(n - 1));
}

bool holds(const analysis::CapabilityIndex& index, double value) {
  return index.interval.low <= value && value <= index.interval.high;
}

}  // namespace

TEST_CASE("the textbook's interval of Cp", "[analysis][station][literature]") {
  // Montgomery, Introduction to Statistical Quality Control: limits 38 and 62, n = 20, s = 1.75:
  // 2.29, and 1.57 to 3.01 at 95 %, by chi-square of two digits.
  const Capability capability = told(capability_of(of_mean_and_s(20, 50, 1.75), {38, 62}));
  CHECK(capability.pp->value == Approx(2.29).margin(0.005));
  CHECK(capability.pp->interval.low == Approx(1.57).margin(0.01));
  CHECK(capability.pp->interval.high == Approx(3.01).margin(0.01));
}

TEST_CASE("the nearer limit makes Ppk, with Bissell's interval", "[analysis][station]") {
  const Capability capability = told(capability_of(of_mean_and_s(20, 54, 2), {38, 62}));
  const double ppk = 8.0 / 6;
  CHECK(capability.ppk.value == Approx(ppk));
  const double reach = 1.959964 * std::sqrt(1.0 / 180 + ppk * ppk / 38);
  CHECK(capability.ppk.interval.low == Approx(ppk - reach));
  CHECK(capability.ppk.interval.high == Approx(ppk + reach));
  CHECK(capability.pp->value == Approx(2));
}

TEST_CASE("one limit makes no Cp, and a mean beyond it a Cpk below 0", "[analysis][station]") {
  const Capability upper = told(capability_of(of_mean_and_s(30, 65, 2), {{}, 62}));
  CHECK_FALSE(upper.cp);
  CHECK_FALSE(upper.pp);
  CHECK(upper.ppk.value == Approx(-0.5));
  CHECK(upper.cpk.value < 0);
  const Capability lower = told(capability_of(of_mean_and_s(30, 65, 2), {59, {}}));
  CHECK(lower.ppk.value == Approx(1));
}

TEST_CASE("a drift is in Ppk, not in Cpk", "[analysis][station]") {
  const Eigen::VectorXd drift = test::white_noise(100, 3) + Eigen::VectorXd::LinSpaced(100, -3, 3);
  const Capability capability = told(capability_of(drift, {-9, 9}));
  CHECK(capability.cpk.value > 1.5 * capability.ppk.value);
}

TEST_CASE("intervals hold the truth as often as they say", "[analysis][station]") {
  constexpr int draws = 600;
  int of_cp = 0, of_cpk = 0, of_pp = 0, of_ppk = 0;
  for (unsigned draw = 0; draw < draws; ++draw) {
    // Limits 4 σ below and 5 σ above the mean: Cp = 1.5, Cpk = 4/3.
    const Capability c = told(capability_of(test::white_noise(40, 50 + draw), {-4, 5}));
    of_cp += holds(*c.cp, 1.5) ? 1 : 0;
    of_cpk += holds(c.cpk, 4.0 / 3) ? 1 : 0;
    of_pp += holds(*c.pp, 1.5) ? 1 : 0;
    of_ppk += holds(c.ppk, 4.0 / 3) ? 1 : 0;
  }
  const double give = 4 * std::sqrt(0.05 * 0.95 / draws);
  CHECK(of_pp / double(draws) == Approx(0.95).margin(give));
  for (const int held : {of_cp, of_cpk, of_ppk}) {
    CHECK(held / double(draws) == Approx(0.95).margin(give + 0.01));  // approximate ones
  }
}

TEST_CASE("values that are not normal are told", "[analysis][station]") {
  const Eigen::VectorXd skewed = test::white_noise(60, 9).array().exp();
  CHECK(told(capability_of(skewed, {{}, 20})).normality_p < 1e-3);
  const Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(200, 0, 1);
  CHECK(normality_p_value(even) < 0.01);
  CHECK(normality_p_value(Eigen::VectorXd::Constant(20, 1)) == 0);
  Eigen::VectorXd outlier = test::white_noise(30, 1);
  outlier[3] = 1e6;
  CHECK(normality_p_value(outlier) < 1e-5);
  CHECK_THROWS_AS(normality_p_value(test::white_noise(7, 1)), std::invalid_argument);
}

TEST_CASE("normal values are called normal as often as stated", "[analysis][station][null]") {
  const Eigen::Index n = GENERATE(20, 100);
  CAPTURE(n);
  test::NullDraws draws;
  for (unsigned draw = 0; draw < 2000; ++draw) {
    draws.p_values.push_back(normality_p_value(test::white_noise(n, draw + 1)));
  }
  CHECK_THAT(draws, test::UniformBelow({0.01, 0.05, 0.1, 0.5, 0.9}));
}

TEST_CASE("capability without limits, or between none, does not exist", "[analysis][station]") {
  const Eigen::VectorXd values = test::white_noise(20, 1);
  CHECK_THROWS_AS(capability_of(values, {}), std::invalid_argument);
  CHECK_THROWS_AS(capability_of(values, {2, 2}), std::invalid_argument);
  CHECK_THROWS_AS(capability_of(Eigen::VectorXd::Constant(20, 1), {0, 2}), std::invalid_argument);
  CHECK_THROWS_AS(capability_of(values.head(7), {0, 2}), std::invalid_argument);
}

TEST_CASE("an index of what overflows does not exist", "[analysis][station]") {
  const auto why = [](const Eigen::VectorXd& values, double upper) {
    return std::get<std::string>(capability_of(values, {{}, upper}));
  };
  const Eigen::VectorXd values = test::white_noise(20, 1);
  CHECK_THAT(why(1e305 * values, 1), Catch::Contains("cannot tell: the standard deviation is no"));
  CHECK_THAT(why(1e-100 * values, 1e300), Catch::Contains("cannot tell: an index is no finite"));
}
