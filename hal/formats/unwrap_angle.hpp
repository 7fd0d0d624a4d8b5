#pragma once

#include <Eigen/Core>

namespace rvbench::hal::formats {

/// Adds the turns that an encoder leaves out which starts anew after each turn. An angle is wrapped
/// if it stays within one turn, jumps by more than half of one, and mostly moves by less than a
/// quarter between two samples.
///
/// @return whether it was wrapped; if not, nothing is changed
/// Units   rad; a sample that is not finite stays so
/// Errors  none thrown. Source  definition
bool unwrap_angle(Eigen::VectorXd& angle_rad);

}  // namespace rvbench::hal::formats
