#pragma once

#include <Eigen/Core>
#include <memory>
#include <random>
#include <vector>

#include "sim/contact_noise.hpp"
#include "sim/decimator.hpp"
#include "sim/plant.hpp"
#include "sim/rv_unit.hpp"
#include "sim/spalled_race.hpp"
#include "sim/terms/cycloid_stage.hpp"
#include "sim/terms/friction.hpp"
#include "sim/terms/induction_motor.hpp"
#include "sim/terms/planet_mesh.hpp"
#include "sim/terms/shaft_torsion.hpp"

namespace rvbench::sim {

/// The RV-20E on its bench: motor, coupling with transducer, reducer, brake, housing, sensors.
///
/// Bodies   0 motor, 1 input shaft with sun, 2.. one crank with planet each, carrier, brake
/// Time     one call of step() is one sample of the DAQ
/// Leaves out: temperature's effect on friction, backlash, the mounts of the bench
class RvBench {
 public:
  static constexpr double rate_Hz = 4960;
  static constexpr int sensors = 12;

  explicit RvBench(const RvUnit& unit);

  void set_supply(double frequency_Hz, bool enabled) { motor_->set_supply(frequency_Hz, enabled); }
  void set_brake_torque(double torque_Nm) { brake_->set_coulomb_Nm(torque_Nm); }

  /// One DAQ sample on. @param accelerations_m_s2  size `sensors`, out
  void step(Eigen::Ref<Eigen::VectorXf> accelerations_m_s2);

  double input_torque_Nm() const { return coupling_->torque_Nm(plant_->state()); }
  double input_angle_rad() const;  ///< unwrapped since the start
  double motor_speed_rad_s() const { return plant_->state().v[0]; }
  double output_speed_rad_s() const;
  double brake_torque_Nm() const;  ///< passed to the brake
  double motor_torque_Nm() const { return motor_->torque_Nm(motor_speed_rad_s()); }

 private:
  void make_plant(const RvUnit& unit);
  void make_noise(const RvUnit& unit);
  void settle();
  void wrap();
  void gather_forces();
  void add_input_bearing(double shaft_rad, double speed_ratio, const Eigen::Vector2d& sun_load_N);
  Eigen::Vector2d add_sun_meshes(double carrier_rad, double speed_ratio);
  void add_pin_shell(double speed_ratio);
  void add_crank_bearings(double carrier_rad, double speed_ratio);

  RvUnit unit_;
  std::unique_ptr<Plant> plant_;
  InductionMotor* motor_ = nullptr;  ///< owned by the plant, as are the terms below
  ShaftTorsion* coupling_ = nullptr;
  ShaftTorsion* output_shaft_ = nullptr;
  Friction* brake_ = nullptr;
  std::vector<PlanetMesh*> meshes_;
  std::vector<CycloidStage*> stages_;
  double wrapped_turns_ = 0;

  HousingPath housing_;
  Decimator decimator_;
  SpalledRace spall_;
  PeriodicTable bad_flank_, bad_pin_, sun_roughness_;
  std::vector<ContactNoise> bearing_noise_, mesh_noise_, pin_noise_, crank_noise_;
  Eigen::VectorXd forces_N_, accelerations_;
  std::mt19937_64 sensor_engine_;
  std::normal_distribution<float> sensor_noise_;
};

}  // namespace rvbench::sim
