#pragma once

#include <string>
#include <variant>
#include <vector>

#include "analysis/station/control_chart.hpp"
#include "analysis/station/ewma_chart.hpp"

namespace rvbench::analysis {

/// A run of the golden unit against all those before it.
struct GoldenCheck {
  ChartBaseline baseline;
  double value = 0;
  std::vector<const ControlRule*> fired;  ///< at this run
  bool is_wide = false;                   ///< its step from the run before is above the limit
  bool has_drifted = false;               ///< its EWMA is beyond its limits

  bool is_in_control() const { return fired.empty() && !is_wide && !has_drifted; }

  /// "in control"; or what fired: "out of control: western_electric_1 (beyond 3 sigma), EWMA ..."
  std::string text() const;
};

/// What the golden unit's newest run says of the station.
///
/// Its chart is made of its first `baseline_points` runs, taken while the station was known to be
/// sound, and stays: one that learns from every run would learn a drift as well. Rules are asked
/// of the newest point alone, with those before it.
///
/// @param runs  in the order of time, in one unit; the newest last
/// @return why there is none otherwise: too few runs, with the number it takes, a baseline without
///         scatter, or values whose chart is no finite numbers
/// @throws std::invalid_argument if a value is not finite
/// Source  Western Electric's four zone rules, chart_of(), ewma_of()
std::variant<GoldenCheck, std::string> check_golden(const Eigen::Ref<const Eigen::VectorXd>& runs,
                                                    Eigen::Index baseline_points = good_baseline);

}  // namespace rvbench::analysis
