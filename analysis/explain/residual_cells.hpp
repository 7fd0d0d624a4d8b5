#pragma once

#include <string>
#include <vector>

namespace rvbench::analysis {

/// What a number that is compared stays with when the speed changes.
enum class LockedTo {
  nothing,   ///< a mean
  shaft,     ///< a line at an order of the reference shaft
  time,      ///< a line at a frequency
  programme  ///< a mean over a stretch of a motion that is repeated
};

const char* to_string(LockedTo locked) noexcept;  ///< "mean", "order", "Hz", "s"

/// A mean, one line, or one stretch, of one channel under one condition: measured beside
/// predicted.
struct ResidualCell {
  std::string channel, unit, condition;
  LockedTo locked_to = LockedTo::nothing;
  double place = 0;  ///< order of the reference shaft, Hz, or s of a programme; 0 of a mean
  double apart = 0;  ///< measured − predicted, in `unit`, mean of the condition's records
  double standard_error = 1;          ///< of that, > 0
  std::string speed = {}, load = {};  ///< labels of the condition's
  bool is_new = false;                ///< a line that the plant itself does not show
};

/// Where measurement and prediction differ by more than chance: a mean, or lines beside each other,
/// of one channel, under all conditions where they do.
struct ResidualCluster {
  std::string channel, unit;
  LockedTo locked_to = LockedTo::nothing;
  double first = 0, last = 0;  ///< orders, Hz, or s
  std::vector<std::string> conditions;
  double apart = 0;            ///< of the cell that is off by most standard errors
  double standard_errors = 0;  ///< of that cell, with its sign
  double together = 0;         ///< root of the sum of squares of the most of each condition
  bool is_new = false;  ///< see ResidualCell; of none of its cells does the plant show a line
};

/// Which hypotheses to reject so that, of those rejected, a share of q is rejected wrongly on
/// average.
/// @return per p-value: whether it is rejected
/// Errors  none thrown
/// Source  Benjamini & Hochberg, J. R. Stat. Soc. B 57(1), 289-300 (1995)
std::vector<bool> discoveries(const std::vector<double>& p_values, double q);

/// Cells that differ by more than chance, gathered. Means, orders, frequencies, and the stretches
/// of each programme, of each channel, are a family: it is looked into if it as a whole differs by
/// more than chance.
/// @param beside  orders that are this far apart belong together, and so do frequencies and times
/// @return farthest off first
/// Units   of the cells. Errors  none thrown: standard errors are above 0
/// Source  Simes, Biometrika 73(3), 751-754 (1986), for the families
std::vector<ResidualCluster> locate(const std::vector<ResidualCell>& cells, double beside,
                                    double q = 0.05);

}  // namespace rvbench::analysis
