#pragma once

#include <string>

#include "sequences/plan.hpp"

namespace rvbench::bench {

/// What --dry-run prints: every stretch of the plan with start, length, speed, torque and input
/// power, then the total time, the number of points and the envelope of torque and power.
/// Input power is what the motor must give a loss-free reducer: output torque / ratio · speed.
std::string timeline_table(const sequences::TestPlan& plan);

/// The same as one JSON document.
std::string timeline_json(const sequences::TestPlan& plan);

}  // namespace rvbench::bench
