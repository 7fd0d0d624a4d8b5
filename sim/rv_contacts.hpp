#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/contact_noise.hpp"
#include "sim/periodic_table.hpp"
#include "sim/rv_train.hpp"
#include "sim/rv_unit.hpp"
#include "sim/spalled_race.hpp"

namespace rvbench::sim {

/// Where the train leans on its housing: the forces at the housing's ports, with what the contacts
/// add to them: roughness, a bad flank, a proud pin, a spall.
///
///     f = F + noise(F·roughness), F by the train's state, in the direction in which it points now
///
/// Leaves out: what the housing's own motion does to the contacts.
/// Source: Mark, J. Acoust. Soc. Am. 63, 1409-1430 (1978), for noise that follows the force
class RvContacts {
 public:
  /// @param train  the one of forces_N()  @param rate_Hz  at which forces_N() is called
  RvContacts(const RvUnit& unit, const RvTrain& train, double rate_Hz);

  /// Forces at the ports [N] (see sim::ports) while the train is in this state; one step of noise.
  const Eigen::VectorXd& forces_N(const RvTrain& train);

 private:
  void add_input_bearing(double shaft_rad, double speed_ratio, const Eigen::Vector2d& sun_load_N);
  Eigen::Vector2d add_sun_meshes(const RvTrain& train, double speed_ratio);
  void add_pin_shell(const RvTrain& train, double speed_ratio);
  void add_crank_bearings(const RvTrain& train, double speed_ratio);

  RvUnit unit_;
  double step_s_;
  SpalledRace spall_;
  PeriodicTable bad_flank_, bad_pin_, sun_roughness_;
  std::vector<ContactNoise> bearing_noise_, mesh_noise_, pin_noise_, crank_noise_;
  Eigen::VectorXd forces_N_;
};

}  // namespace rvbench::sim
