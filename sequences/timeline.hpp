#pragma once

#include <vector>

#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// Setup and main of a plan as they will run, with the shortest settling.
std::vector<Segment> timeline(const TestPlan& plan);

double planned_duration_s(const TestPlan& plan);

}  // namespace rvbench::sequences
