#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "analysis/station/control_rules.hpp"

namespace rvbench::analysis {

/// What a process is like when nothing but chance acts on it.
struct ChartBaseline {
  Eigen::Index points = 0;
  double centre = 0;      ///< mean
  double mean_range = 0;  ///< mean of the ranges |x_i - x_(i-1)|
  double sigma = 0;       ///< mean range/1.128

  double lower() const { return centre - 3 * sigma; }
  double upper() const { return centre + 3 * sigma; }
  double upper_range() const;  ///< 3.267·mean range; the lower limit is 0
};

/// The fewest points a baseline is taken from, and how many make one that is worth its name.
inline constexpr Eigen::Index least_baseline = 8;
inline constexpr Eigen::Index good_baseline = 20;

/// Individuals and moving range: centre ± 2.66·mean range, ranges up to 3.267·mean range.
///
/// The ranges of neighbours do not see what drifts or jumps once: their σ is that of chance alone.
///
/// Shape   least_baseline values or more, in the order of time. Units  of the values
/// @return why there is none otherwise: centre or limits are no finite numbers
/// Errors  throws std::invalid_argument: fewer, or one not finite
/// Limits  σ is 0 where all values are alike: no chart can be made of that
/// Source  Shewhart (1931); constants from E|x - y| = 2σ/√π of normal values: NIST/SEMATECH
///         e-Handbook of Statistical Methods, sec. 6.3.2.2
std::variant<ChartBaseline, std::string> baseline_of(
    const Eigen::Ref<const Eigen::VectorXd>& values);

/// Values against a baseline, which may be that of their first ones.
struct ControlChart {
  ChartBaseline baseline;
  Eigen::VectorXd values;
  Eigen::VectorXd ranges;                 ///< |x_i - x_(i-1)|; the first is NaN
  std::vector<RuleSignal> signals;        ///< of the individuals
  std::vector<Eigen::Index> wide_ranges;  ///< points whose range is above its limit

  bool is_in_control() const { return signals.empty() && wide_ranges.empty(); }
};

/// @return why there is none otherwise: a range, or a distance from the centre, is no finite number
/// @throws std::invalid_argument if a value is not finite or the baseline's σ is not above 0
/// Source  of baseline_of() and the rules
std::variant<ControlChart, std::string> chart_of(const Eigen::Ref<const Eigen::VectorXd>& values,
                                                 const ChartBaseline& baseline,
                                                 const std::vector<ControlRule>& rules);

}  // namespace rvbench::analysis
