#pragma once

#include <optional>

#include "analysis/tpa/sensor_roles.hpp"

namespace rvbench::analysis {

/// One thing that may be wrong with one indicator in operation, against what it was at the hammer
/// test.
struct SensorChange {
  DegreeOfFreedom sensor;
  std::optional<DegreeOfFreedom> swapped_with;  ///< a direction of the same point; none: its sign
  double unexplained_before = 0;  ///< share of the indicators' power outside the paths' reach,
  double unexplained_after = 0;   ///< mean over the lines; and with the change undone
};

/// The change of sign of one indicator, or swap of two directions of one point, that lets the paths
/// explain most; nothing if no single change halves what is unexplained.
///
/// Every line counts alike, whatever its power.
///
/// @param is_used  one per line, empty for all
/// Shape   lines of both
/// Units   none
/// Errors  throws std::invalid_argument: fewer indicators than paths or as many, a sensor that is
///         not there, other lines
/// Limits  one change at a time; what is wrong at the hammer test and in operation alike is not
///         seen here, but by reciprocity and driving points
/// Source  ours
std::optional<SensorChange> find_sensor_change(const FrfMatrix& frfs,
                                               const OperatingSpectra& operating,
                                               const SensorRoles& roles,
                                               std::vector<bool> is_used = {});

}  // namespace rvbench::analysis
