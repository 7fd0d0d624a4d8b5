#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/types/measure.hpp"
#include "hal/types/set_point.hpp"
#include "sequences/plan.hpp"

/// Where a plan and limits meet: whether what it records can be held against them.
/// Errors  none thrown. Source  Measure::phase, Measure::takes_repeats
namespace rvbench::sequences {

/// The key of a limit that makes it one which no record of the plan is held against, and why.
struct LimitMismatch {
  std::string key;
  std::string why;
};

/// Nothing if a record of the plan can be held against the limit.
std::optional<LimitMismatch> mismatch_of(const Limit& limit, const TestPlan& plan);

/// Those that no record of the plan can be held against, as faults without lines.
std::vector<hal::ConfigFault> limits_without_points(const std::vector<Limit>& limits,
                                                    const TestPlan& plan);

/// The points of the matrix, each once, that show the measure; in the order of the plan.
std::vector<SetPoint> set_points_of(const Measure& measure, const TestPlan& plan);

}  // namespace rvbench::sequences
