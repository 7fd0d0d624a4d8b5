#pragma once

#include <vector>

#include "analysis/indicators/indicator.hpp"
#include "analysis/kinematics.hpp"
#include "analysis/shaft_angle.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Indicators of torques and angles, over whole periods of the gear train: ripple of input_torque
/// and output_torque; efficiency, where both torques and both angles are recorded; transmission
/// error, where both angles are.
///
/// A channel that is not there, holds no whole period, lost a sample or has another clock than its
/// partner makes no indicator: the list is shorter.
///
/// Shape    channels of any rate → at most four indicators
/// Units    torques in one unit, angles in rad → dimensionless; transmission error in arcsec
/// Errors   none thrown
/// Source   torque_ripple(), mean_power_W(), efficiency(), transmission_error()
std::vector<Indicator> shaft_indicators(const Recording& record, const ShaftAngle& angle,
                                        const Kinematics& kinematics);

}  // namespace rvbench::analysis
