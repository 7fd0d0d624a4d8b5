#include "analysis/station/golden_check.hpp"

#include <algorithm>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

std::string GoldenCheck::text() const {
  if (is_in_control()) return "in control";
  std::vector<std::string> reasons;
  for (const ControlRule* rule : fired) {
    reasons.push_back(std::string(rule->name) + " (" + std::string(rule->meaning) + ")");
  }
  if (is_wide) reasons.emplace_back("moving range above its limit");
  if (has_drifted) reasons.emplace_back("EWMA beyond its limits: a drift");
  std::string text = "out of control: " + reasons.front();
  for (std::size_t i = 1; i < reasons.size(); ++i) text += ", " + reasons[i];
  return text;
}

std::variant<GoldenCheck, std::string> check_golden(const Eigen::Ref<const Eigen::VectorXd>& runs,
                                                    Eigen::Index baseline_points) {
  constexpr Require require{"check_golden"};
  require(runs.allFinite(), "a value is not finite");
  require(baseline_points >= least_baseline, "too few baseline points");
  if (runs.size() <= baseline_points) {
    return std::to_string(runs.size()) + (runs.size() == 1 ? " run" : " runs") +
           " of the golden unit: its chart takes " + std::to_string(baseline_points) +
           ", and the one that is checked";
  }
  const auto made = baseline_of(runs.head(baseline_points));
  if (const auto* why = std::get_if<std::string>(&made)) return *why;
  const auto& baseline = std::get<ChartBaseline>(made);
  if (!(baseline.sigma > 0)) {
    return "the first " + std::to_string(baseline_points) +
           " runs of the golden unit are all alike: too coarse for a chart";
  }
  // The EWMA starts where the baseline ends: what came before has made the centre.
  const Eigen::VectorXd since = runs.tail(runs.size() - baseline_points);
  const Eigen::Index newest = runs.size() - 1;
  const auto charted = chart_of(runs, baseline, western_electric_rules());
  if (const auto* why = std::get_if<std::string>(&charted)) return *why;
  const auto weighted = ewma_of(since, baseline);
  if (const auto* why = std::get_if<std::string>(&weighted)) return *why;
  const auto& chart = std::get<ControlChart>(charted);
  const auto& ewma = std::get<EwmaChart>(weighted);
  GoldenCheck check{baseline, runs[newest], {}, false, false};
  for (const RuleSignal& signal : chart.signals) {
    if (signal.at == newest) check.fired.push_back(signal.rule);
  }
  check.is_wide = std::ranges::find(chart.wide_ranges, newest) != chart.wide_ranges.end();
  check.has_drifted = !ewma.out.empty() && ewma.out.back() == since.size() - 1;
  return check;
}

}  // namespace rvbench::analysis
