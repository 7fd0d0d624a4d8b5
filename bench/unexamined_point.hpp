#pragma once

#include <string>

#include "bench/judgement.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::bench {

/// A point of the plan that there is no record of to examine, and why.
/// @param number  of the point, from 0
/// Errors  none thrown. Source  the plan
JudgedPoint unexamined_point(const hal::PlannedPoint& planned, int number, std::string status);

}  // namespace rvbench::bench
