#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/judgement.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {

/// What is asked of all points and channels together.
struct WorstOf {
  const Measure& measure;
  std::string unit;          ///< of the answer; what cannot be told in it counts as not measured
  bool least = false;        ///< the smallest value is the worst
  std::string_view of = {};  ///< one band, order, mesh or channel; empty: every one
  SetPoint at = {};          ///< at these points of the matrix alone
};

/// The worst of one indicator, and where it could not be measured. Points that the measure is not
/// of (Measure::phase) do not count.
struct WorstIndicator {
  double value = not_known;  ///< in the unit asked for; NaN: not measured anywhere
  double error = not_known;  ///< half of its 95 % interval, in that unit
  std::string where;         ///< "recording.h5#000, accel_1x, sun-planet mesh"
  std::size_t points = 0;    ///< that were examined and are of the measure's kind
  /// Those of them without it, each by the first place that lacks it. A point has it when each of
  /// its channels has it of everything that any record shows it of; where a sound record may lack
  /// it (Measure::absent_when), when one channel has it.
  std::vector<std::string> lacking;
};

/// Looks for the worst value of one indicator at all points that were examined.
///
/// Shape   any number of points and channels → one value, with the points that lack it
/// Units   WorstOf::unit; a value in a unit that does not lead to it is not measured
/// Errors  none thrown. Source  ours
WorstIndicator worst_indicator(const Judgement& judgement, const WorstOf& asked);

}  // namespace rvbench::bench
