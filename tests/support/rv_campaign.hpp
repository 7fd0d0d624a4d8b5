#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "bench/campaign.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::test {

/// How an RV bench is run through its matrix, and what its sensors add.
struct RvMatrix {
  std::vector<double> speeds_rpm{605, 1210, 1815};
  std::vector<double> loads_pct{0, 75, 150};
  int repeats = 3;
  double periods = 4.5;             ///< output turns of each record
  double torque_noise_Nm = 2e-3;    ///< rms
  double noise_colour = 0.5;        ///< pole of a one-pole filter
  double friction_scatter = 0.005;  ///< of the input shaft's friction, from record to record
  double torque_gain = 1;
  double torque_delay_samples = 0;  ///< of the torque behind the angle, to a fifth of a sample
};

/// Of the plant's supply and brake under a corner of the matrix.
Eigen::Vector2d rv_inputs(double speed_rpm, double load_pct);

/// Records of torque and angle of the input shaft as the train integrates them in time: nothing
/// here knows orders or steady states.
bench::Campaign rv_campaign(const sim::PlantSpec& machine, std::uint64_t seed,
                            const RvMatrix& matrix = {});

/// The plant with each quantity that has a tolerance somewhere within this share of it.
sim::PlantSpec within_tolerance(sim::PlantSpec plant, std::uint64_t seed, double share = 0.8);

/// The plant with an error of its meshes, 3 µm and known to a half: their lines are its strongest.
sim::PlantSpec with_mesh_error(sim::PlantSpec plant);

/// The plant with another value at a pointer, as "/terms/4/parameters/profile_error".
sim::PlantSpec with_value(sim::PlantSpec plant, const std::string& pointer, double value);

}  // namespace rvbench::test
