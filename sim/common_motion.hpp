#pragma once

#include <Eigen/Core>
#include <variant>

#include "hal/config_reader.hpp"
#include "sim/plant_model.hpp"

namespace rvbench::sim {

/// Turns of each body while the slowest makes one: the one motion that the linear springs let pass.
/// 0 of a body that is held.
/// @return a fault if bodies can turn by themselves, or have no common period
std::variant<Eigen::VectorXd, hal::ConfigFault> common_motion(const PlantModel& model);

/// A term that pushes otherwise once the bodies have made these turns; nullptr if none can tell.
const PhysicsTerm* held_by(const PlantModel& model, const Eigen::VectorXd& turns);

}  // namespace rvbench::sim
