#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::bench {

/// Where rows are missing between time stamps.
struct LostRows {
  Eigen::Index before = 0;  ///< rows before the gap
  double count = 0;         ///< about how many are missing
};

/// The largest gap in time stamps that rise: there they jump for good against an even clock, by
/// half a step or more. So does their mean over 50 rows before and behind; it must stand out
/// eightfold from how that of a clock that drifts, jitters or is printed coarsely wanders anyway.
/// And so does the earliest one of 200, which a stamp that is late now and then is not.
///
/// Shape   N stamps in any unit; nothing of fewer than 100, nor of any that are not finite
/// Limits  a gap of few rows is not seen among stamps that jitter by about a step or are the same
///         for many rows, nor any where gaps come every hundred rows: that is the clock's own step
/// Errors  none thrown. Source  ours
std::optional<LostRows> find_lost_rows(const Eigen::VectorXd& time);

}  // namespace rvbench::bench
