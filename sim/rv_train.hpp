#pragma once

#include <memory>
#include <vector>

#include "sim/plant.hpp"
#include "sim/rv_unit.hpp"
#include "sim/terms/cycloid_stage.hpp"
#include "sim/terms/friction.hpp"
#include "sim/terms/induction_motor.hpp"
#include "sim/terms/planet_mesh.hpp"
#include "sim/terms/shaft_torsion.hpp"

namespace rvbench::sim {

/// What turns on the bench: motor, coupling with transducer, the RV-20E's two stages, brake.
///
/// Bodies   0 motor, 1 input shaft with sun, 2.. one crank with planet each, carrier, brake
/// Leaves out: temperature's effect on friction, backlash
class RvTrain {
 public:
  RvTrain(const RvUnit& unit, double step_s);

  void set_supply(double frequency_Hz, bool enabled) { motor_->set_supply(frequency_Hz, enabled); }
  void set_brake_torque(double torque_Nm) { brake_->set_coulomb_Nm(torque_Nm); }
  void step();

  /// Takes whole output turns out of the angles, which no term can tell: they stay precise over a
  /// long test.
  void wrap();

  const PlantState& state() const { return plant_->state(); }
  const std::vector<PlanetMesh*>& meshes() const { return meshes_; }    ///< of each planet
  const std::vector<CycloidStage*>& stages() const { return stages_; }  ///< of each crank

  double input_torque_Nm() const { return coupling_->torque_Nm(state()); }
  double input_angle_rad() const;  ///< unwrapped since the start
  double input_speed_rad_s() const { return state().v[1]; }
  double carrier_angle_rad() const { return state().q[state().q.size() - 2]; }  ///< wrapped
  double crank_angle_rad(std::size_t k) const;  ///< against the carrier, wrapped
  double place_rad(std::size_t k) const;        ///< of planet and crank k in the housing, wrapped
  double motor_speed_rad_s() const { return state().v[0]; }
  double motor_torque_Nm() const { return motor_->torque_Nm(motor_speed_rad_s()); }
  double output_speed_rad_s() const { return state().v[state().v.size() - 1]; }
  double brake_torque_Nm() const { return output_shaft_->torque_Nm(state()); }

 private:
  using Terms = std::vector<std::unique_ptr<PhysicsTerm>>;

  void add_input(const RvUnit& unit, Terms& terms);
  void add_stages(const RvUnit& unit, Terms& terms);
  void add_output(const RvUnit& unit, Terms& terms);

  std::unique_ptr<Plant> plant_;
  InductionMotor* motor_ = nullptr;  ///< owned by the plant, as are the terms below
  ShaftTorsion* coupling_ = nullptr;
  ShaftTorsion* output_shaft_ = nullptr;
  Friction* brake_ = nullptr;
  std::vector<PlanetMesh*> meshes_;
  std::vector<CycloidStage*> stages_;
  double wrapped_turns_ = 0;
};

}  // namespace rvbench::sim
