#pragma once

#include <optional>
#include <vector>

#include "analysis/kinematics.hpp"
#include "analysis/shaft_angle.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// A stated speed, corrected by how far the meshes' lines are off it.
/// @return  empty where they are not seen surely enough to place all that belongs to them
std::optional<ShaftAngle> corrected_by_lines(const std::vector<const Channel*>& channels,
                                             const ShaftAngle& stated,
                                             const Kinematics& kinematics);

}  // namespace rvbench::analysis
