#pragma once

#include <vector>

namespace rvbench::analysis {

/// How a quantity moves over time.
struct SlopeOverTime {
  double slope = 0;  ///< per unit of x
  double low = 0;    ///< of its 95 % interval
  double high = 0;
  double level = 0;       ///< median of y: of the line at the median of x
  double dependence = 1;  ///< by what the interval's variance was widened: neighbours were alike

  /// Whether it rises or falls; else no trend can be told.
  bool is_told() const { return low > 0 || high < 0; }
};

/// Fewer say nothing: the interval is of a normal approximation.
inline constexpr std::size_t fewest_for_slope = 10;
/// More are too many: slopes are of all pairs.
inline constexpr std::size_t most_for_slope = 2000;

/// Theil-Sen line with Sen's interval for its slope: outliers, up to 29 % of the values, do not
/// move it, and no distribution is taken for granted.
///
/// Shape   N pairs, fewest_for_slope to most_for_slope, in order of x → one line
/// Units   y in [u], x in [v] → slope in [u/v]
/// Errors  throws std::invalid_argument: other N, x and y of two lengths, not finite, x falling or
///         all alike
/// Limits  the interval is for independent values. Where neighbours are alike (lag-1 correlation r
///         of the residuals above what chance shows, one-sided 5 %) its variance is widened by
///         1 + 2 Σ (1 − k/N) rᵏ (Yue & Wang 2004)
/// Source  Sen, J. Am. Stat. Assoc. 63, 1379-1389 (1968): interval from the variance of Kendall's
///         S with ties; Yue & Wang, Water Resour. Manag. 18, 201-218 (2004)
SlopeOverTime theil_sen(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace rvbench::analysis
