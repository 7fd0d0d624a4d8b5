#pragma once

#include <vector>

#include "hal/config_reader.hpp"
#include "hal/rig.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// What the plan asks for and the rig cannot do, a limit on what it does not record among it, or on
/// what no point of the plan shows: faults of the plan's file, or of that of its limits, without
/// lines. Of a rig that is not connected yet, too; a front end that takes another rate than it was
/// asked for shows only afterwards.
std::vector<hal::ConfigFault> faults_of_plan_on(const hal::Rig& rig, const TestPlan& plan);

}  // namespace rvbench::sequences
