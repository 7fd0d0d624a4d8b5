#pragma once

#include <optional>

#include "analysis/shaft_angle.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Shaft angle from samples of its speed, as an inverter reports them: the integral of a natural
/// spline through the samples. Lost samples (NaN) are left out of the spline.
///
/// Shape    N speeds → an angle at 8 times as many even times; empty if fewer than 4 are finite,
///          if the shaft turned back, or never turned
/// Units    rad/s (channel), turns
/// Errors   throws std::invalid_argument: rate_Hz not finite and positive
/// Limits   h the step: the angle drifts by the mean error of the speed times the record's length.
///          An inverter that reports the frequency it puts out, not the speed it measures, leaves
///          out the slip of an asynchronous motor, 1 to 5 %: no order is then where it belongs.
///          Ripple faster than 1/(2h) is not seen; slower, at f, its angle is right to
///          (5/384)·(2πfh)⁴ of itself
/// Source   Hall & Meyer, J. Approx. Theory 16, 105-122 (1976), for the spline
std::optional<ShaftAngle> angle_of_speed(const Channel& speed_rad_s);

}  // namespace rvbench::analysis
