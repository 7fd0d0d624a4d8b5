#pragma once

#include <vector>

#include "hal/config_reader.hpp"
#include "hal/rig.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// What the plan asks for and the rig, which need not be connected, cannot do: faults of the plan's
/// file, without lines. A front end that takes another rate than it was asked for shows only when
/// it is connected; then the sequencer refuses.
std::vector<hal::ConfigFault> faults_of_plan_on(const hal::Rig& rig,
                                                const sequences::TestPlan& plan);

}  // namespace rvbench::bench
