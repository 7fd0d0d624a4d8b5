#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "sim/plant_model.hpp"

namespace rvbench::sim {

/// What of a plant that turns steadily follows time and not its angle: clocks, and terms that have
/// a rhythm of their own.
class TermRhythms {
 public:
  /// @param model  outlives the rhythms
  /// @param still  the plant without speed, under its inputs
  /// @param turns  of each body while the slowest makes one
  TermRhythms(const PlantModel& model, PlantState still, const Eigen::VectorXd& turns);

  bool is_one(const PhysicsTerm* term) const;  ///< of the terms that have a rhythm
  /// Goes on as it does while the slowest body turns this fast.
  void keep(double speed_rad_s);
  void set_clocks(PlantState& s, double t_s) const;

  /// What the terms with a rhythm push on average over a period of each, in this state: so
  /// that their line cancels, and its second and third harmonic.
  /// @param remainder_only  without the linear part of the force
  void mean_forces(PlantState& s, bool remainder_only, Eigen::VectorXd& f) const;

 private:
  void keep_at(const PlantState& s);

  const PlantModel& model_;
  PlantState still_;
  Eigen::VectorXd turns_;
  std::vector<std::pair<const PhysicsTerm*, double>> rhythmic_;  // with its rhythm, Hz
  Eigen::VectorXd clock_rates_;
  bool follows_speed_ = false;  // some clock or rhythm
};

}  // namespace rvbench::sim
