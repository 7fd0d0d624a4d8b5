#include "analysis/station/control_chart.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/station/ewma_chart.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/told.hpp"

using namespace rvbench;
using analysis::baseline_of;
using analysis::chart_of;
using analysis::ChartBaseline;
using analysis::ewma_of;
using analysis::EwmaChart;
using analysis::nelson_rules;
using Catch::Matchers::Contains;
using test::told;

TEST_CASE("individuals and ranges of the handbook's batches", "[analysis][station][literature]") {
  // NIST/SEMATECH e-Handbook of Statistical Methods, sec. 6.3.2.2: flow rate of ten batches.
  Eigen::VectorXd flow(10);
  flow << 49.6, 47.6, 49.9, 51.3, 47.8, 51.2, 52.6, 52.4, 53.6, 52.1;
  const ChartBaseline baseline = told(baseline_of(flow));
  CHECK(baseline.centre == Approx(50.81));
  CHECK(baseline.mean_range == Approx(1.8778).margin(5e-5));
  CHECK(baseline.upper() == Approx(55.8041).margin(2e-3));  // the handbook rounds d2 to 1.128
  CHECK(baseline.lower() == Approx(45.8159).margin(2e-3));
  CHECK(baseline.upper_range() == Approx(3.267 * baseline.mean_range).epsilon(1e-3));
  CHECK(told(chart_of(flow, baseline, nelson_rules())).is_in_control());
}

TEST_CASE("the weighted mean of the handbook's example", "[analysis][station][literature]") {
  // NIST/SEMATECH e-Handbook, sec. 6.3.2.4: centre 50, s = 2.0539, weight 0.3.
  Eigen::VectorXd values(20), means(20);
  values << 52.0, 47.0, 53.0, 49.3, 50.1, 47.0, 51.0, 50.1, 51.2, 50.5, 49.6, 47.6, 49.9, 51.3,
      47.8, 51.2, 52.6, 52.4, 53.6, 52.1;
  means << 50.60, 49.52, 50.56, 50.18, 50.16, 49.21, 49.75, 49.85, 50.26, 50.33, 50.11, 49.36,
      49.52, 50.05, 49.38, 49.92, 50.73, 51.23, 51.94, 51.99;
  const ChartBaseline baseline{20, 50, 0, 2.0539};
  const EwmaChart chart = told(ewma_of(values, baseline, {0.3, 3}));
  for (Eigen::Index i = 0; i < 20; ++i) {
    CAPTURE(i);
    CHECK(chart.means[i] == Approx(means[i]).margin(0.0051));
  }
  // The handbook's limits are those of a chart that has run for long.
  CHECK(chart.upper[19] == Approx(52.5884).margin(2e-3));
  CHECK(chart.lower[19] == Approx(47.4115).margin(2e-3));
  CHECK(chart.out.empty());
}

TEST_CASE("the weighted mean's limits are exact from the first point on", "[analysis][station]") {
  // z_1 = λ·x_1 has λ·σ; z_2 has σ·λ·√(1 + (1 - λ)²).
  const ChartBaseline baseline{20, 10, 0, 2};
  const EwmaChart chart = told(ewma_of(Eigen::VectorXd::Constant(2, 10), baseline, {0.2, 3}));
  CHECK(chart.upper[0] == Approx(10 + 3 * 2 * 0.2));
  CHECK(chart.upper[1] == Approx(10 + 3 * 2 * 0.2 * std::sqrt(1 + 0.64)));
  CHECK(chart.lower[1] == Approx(10 - 3 * 2 * 0.2 * std::sqrt(1 + 0.64)));
}

TEST_CASE("a small shift that lasts is found by the weighted mean", "[analysis][station]") {
  // Lucas & Saccucci (1990): one σ after 10 points on average, and a false alarm in 500; three
  // sigma alone need 44.
  const ChartBaseline baseline{20, 0, 0, 1};
  double found = 0, alarm = 0;
  constexpr int charts = 300;
  for (unsigned chart = 0; chart < charts; ++chart) {
    const Eigen::VectorXd values = test::white_noise(3000, chart + 1);
    const EwmaChart quiet = told(ewma_of(values, baseline));
    alarm += quiet.out.empty() ? 3000 : double(quiet.out.front() + 1);
    const EwmaChart shifted = told(ewma_of(values.head(500).array() + 1, baseline));
    found += shifted.out.empty() ? 500 : double(shifted.out.front() + 1);
  }
  CHECK(found / charts > 7);
  CHECK(found / charts < 12);
  CHECK(alarm / charts == Approx(490).epsilon(4 / std::sqrt(double(charts))));
}

TEST_CASE("one jump is wide, and out", "[analysis][station]") {
  Eigen::VectorXd values = test::white_noise(40, 2);
  const ChartBaseline baseline = told(baseline_of(values.head(25)));
  values[33] = 8;
  const auto chart = told(chart_of(values, baseline, nelson_rules()));
  CHECK_FALSE(chart.is_in_control());
  CHECK(std::isnan(chart.ranges[0]));
  CHECK(chart.wide_ranges == std::vector<Eigen::Index>{33, 34});
  CHECK(std::ranges::any_of(chart.signals, [](const analysis::RuleSignal& signal) {
    return signal.at == 33 && signal.rule->name == "nelson_1";
  }));
}

TEST_CASE("no chart without enough points, or of values all alike", "[analysis][station]") {
  CHECK_THROWS_AS(baseline_of(test::white_noise(7, 1)), std::invalid_argument);
  const Eigen::VectorXd flat = Eigen::VectorXd::Constant(20, 3);
  CHECK(told(baseline_of(flat)).sigma == 0);
  CHECK_THROWS_AS(chart_of(flat, told(baseline_of(flat)), nelson_rules()), std::invalid_argument);
  CHECK_THROWS_AS(ewma_of(flat, told(baseline_of(flat))), std::invalid_argument);
  const ChartBaseline sound{20, 0, 1, 1};
  CHECK_THROWS_AS(ewma_of(flat, sound, {0, 3}), std::invalid_argument);
  CHECK_THROWS_AS(chart_of(Eigen::VectorXd::Constant(3, NAN), sound, nelson_rules()),
                  std::invalid_argument);
}

TEST_CASE("what overflows makes no chart", "[analysis][station]") {
  const auto why = [](const auto& answer) { return std::get<std::string>(answer); };
  const auto in_turn = [](double a, double b) {
    Eigen::VectorXd values(10);
    for (Eigen::Index i = 0; i < 10; ++i) values[i] = i % 2 == 0 ? a : b;
    return values;
  };
  CHECK_THAT(why(baseline_of(in_turn(1e308, -1e308))), Contains("cannot tell: a limit of the"));
  CHECK_THAT(why(baseline_of(in_turn(1.1e308, 1e308))), Contains("cannot tell"));
  const ChartBaseline sound{20, -1e308, 1e300, 1e300};
  const auto of = [&](const Eigen::VectorXd& values) {
    return chart_of(values, sound, nelson_rules());
  };
  CHECK_THAT(why(of(in_turn(1e308, -1e308))), Contains("cannot tell: a range is no finite number"));
  CHECK_THAT(why(of(in_turn(1e308, 0.9e308))), Contains("cannot tell: a distance from the centre"));
  const ChartBaseline wide{20, 0, 1e308, 1e308};
  CHECK_THAT(why(ewma_of(in_turn(1, 2), wide, {1, 3})), Contains("cannot tell: a weighted mean"));
  CHECK(told(baseline_of(in_turn(1e306, -1e306))).sigma > 1e306);  // large is not too large
}
