#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sim/joint.hpp"
#include "sim/plant.hpp"
#include "sim/rv_plant.hpp"
#include "sim/terms/cycloid_stage.hpp"
#include "sim/terms/induction_motor.hpp"
#include "sim/terms/planet_mesh.hpp"

namespace rvbench::sim {

/// What turns on the bench: a plant (see rv_plant_faults()) with motor, reducer and brake, driven
/// by inverter and brake, measured by transducer and encoder.
///
/// The brake is dry friction of the torque it is told: below a creep speed it gives less, unless
/// the plant has a holding_brake.
class RvTrain {
 public:
  /// @throws std::invalid_argument if the bench cannot run the plant, naming the first reason
  RvTrain(const PlantSpec& plant, const RvUnit& unit, double step_s);

  void set_supply(double frequency_Hz, bool enabled);
  void set_brake_torque(double torque_Nm) { brake_setpoint_Nm_ = torque_Nm; }
  void step();

  /// Takes whole output turns out of the angles, where no term can tell: they stay precise over a
  /// long test.
  void wrap();

  const PlantState& state() const { return plant_.state(); }
  const std::vector<const PlanetMesh*>& meshes() const { return meshes_; }    ///< of each planet
  const std::vector<const CycloidStage*>& stages() const { return stages_; }  ///< in that order

  /// What the transducer shows: passed on between motor and input shaft, by all that joins them.
  double input_torque_Nm() const { return coupling_.passed(state()); }
  double input_angle_rad() const;                                     ///< unwrapped since the start
  double shaft_angle_rad() const { return state().q[input_shaft_]; }  ///< of the input, wrapped
  double input_speed_rad_s() const { return state().v[input_shaft_]; }
  double crank_angle_rad(std::size_t k) const;  ///< against the carrier, wrapped
  double place_rad(std::size_t k) const;        ///< of planet and crank k in the housing, wrapped
  double motor_speed_rad_s() const { return state().v[motor_]; }
  double motor_torque_Nm() const;
  double output_speed_rad_s() const { return state().v[brake_]; }
  double brake_torque_Nm() const { return output_.passed(state()); }  ///< between carrier and brake

 private:
  RvTrain(PlantModel model, const PlantSpec& plant, double step_s);
  void find_stages();
  Joint input_joint(const PlantSpec& plant) const;

  /// By how much each body turns during one turn of the carrier; empty if some term could tell.
  Eigen::VectorXd output_turn_rad_;
  Plant plant_;
  int motor_, input_shaft_, carrier_, brake_;  ///< bodies
  std::size_t supply_input_, brake_input_;     ///< in PlantState::u
  std::vector<InductionMotor*> motors_;        ///< owned by the plant, as are the terms below
  std::vector<const PlanetMesh*> meshes_;
  std::vector<const CycloidStage*> stages_;
  Joint coupling_, output_;
  bool brake_holds_;  ///< a term of the plant is told the brake's torque
  double brake_setpoint_Nm_ = 0;
  double wrapped_turns_ = 0;
};

}  // namespace rvbench::sim
