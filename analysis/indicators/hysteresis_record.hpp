#pragma once

#include <vector>

#include "analysis/indicators/hysteresis.hpp"
#include "analysis/indicators/indicator.hpp"
#include "analysis/kinematics.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Whether the record is of a hysteresis test: torque and angle of the input shaft are there, and
/// it went to and fro, each way over half of all its angles at least and beyond ten of their steps.
/// Errors  none thrown. Source  ours
bool is_hysteresis_test(const Recording& record);

/// Hysteresis of such a record. The torsion is θ_in/i, less θ_out where the output's angle has the
/// clock of the input's; else the output is taken to stand. The torque is the output's where it has
/// that clock, else i·T_in. Samples that lack one of them are left out.
///
/// Units   channels in N·m and rad, the output's positive where a positive input turns it
/// Errors  none thrown: an i or a rated torque that the kinematics does not know, or clocks that
///         differ, are among `cannot_tell`
/// Source  hysteresis()
Hysteresis hysteresis_of(const Recording& record, const Kinematics& kinematics);

/// What hysteresis() could tell, as lost_motion, torsional_stiffness and hysteresis_width.
/// Units   arcmin, N·m/arcmin. Errors  none thrown. Source  hysteresis()
std::vector<Indicator> hysteresis_indicators(const Hysteresis& told);

}  // namespace rvbench::analysis
