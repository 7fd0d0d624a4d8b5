#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/joint.hpp"
#include "sim/plant_model.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::sim {

/// What the sensors of a plant that turns steadily make of a motion, in order of its outputs: with
/// their gain, without offset and delay.
class SteadySensors {
 public:
  /// @param plant  outlives it, and so does its model
  SteadySensors(const PlantSpec& plant, const PlantModel& model);

  /// Efforts of curved terms alone are not.
  bool is_linear(Eigen::Index output) const;
  double value(Eigen::Index output, const PlantState& s, const Eigen::VectorXd& acceleration) const;
  Eigen::VectorXd values(const PlantState& s, const Eigen::VectorXd& acceleration) const;

 private:
  double unscaled(std::size_t output, const PlantState& s,
                  const Eigen::VectorXd& acceleration) const;

  const PlantSpec& plant_;
  std::vector<int> places_;
  std::vector<Joint> joints_;
};

}  // namespace rvbench::sim
