#include "analysis/station/control_chart.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/station/not_finite.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double mean_per_sigma = 2 * std::numbers::inv_sqrtpi;  // d2 of two: 1.128

// d3 of two, 0.8525: the range of two has the variance 2σ²·(1 - 2/π).
double deviation_per_sigma() { return std::sqrt(2 - 4 / std::numbers::pi); }

VectorXd steps(const Eigen::Ref<const VectorXd>& values) {
  return (values.tail(values.size() - 1) - values.head(values.size() - 1)).cwiseAbs();
}

}  // namespace

double ChartBaseline::upper_range() const {
  return mean_range * (1 + 3 * deviation_per_sigma() / mean_per_sigma);
}

std::variant<ChartBaseline, std::string> baseline_of(const Eigen::Ref<const VectorXd>& values) {
  constexpr Require require{"baseline_of"};
  require(values.size() >= least_baseline, "too few values");
  require(values.allFinite(), "a value is not finite");
  ChartBaseline baseline;
  baseline.points = values.size();
  baseline.centre = values.mean();
  baseline.mean_range = steps(values).mean();
  baseline.sigma = baseline.mean_range / mean_per_sigma;
  if (!are_finite({baseline.lower(), baseline.upper(), baseline.upper_range()})) {
    return not_finite("a limit of the chart");
  }
  return baseline;
}

std::variant<ControlChart, std::string> chart_of(const Eigen::Ref<const VectorXd>& values,
                                                 const ChartBaseline& baseline,
                                                 const std::vector<ControlRule>& rules) {
  constexpr Require require{"chart_of"};
  require(values.size() > 0 && values.allFinite(), "no values, or one that is not finite");
  require(baseline.sigma > 0, "the baseline has no scatter");
  ControlChart chart{baseline, values, VectorXd(values.size()), {}, {}};
  chart.ranges[0] = std::numeric_limits<double>::quiet_NaN();
  chart.ranges.tail(values.size() - 1) = steps(values);
  const VectorXd off = (values.array() - baseline.centre) / baseline.sigma;
  if (!chart.ranges.tail(values.size() - 1).allFinite()) return not_finite("a range");
  if (!off.allFinite()) return not_finite("a distance from the centre");
  chart.signals = rule_signals(off, rules);
  for (Index i = 1; i < values.size(); ++i) {
    if (chart.ranges[i] > baseline.upper_range()) chart.wide_ranges.push_back(i);
  }
  return chart;
}

}  // namespace rvbench::analysis
