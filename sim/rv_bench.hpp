#pragma once

#include <Eigen/Core>
#include <random>

#include "sim/decimator.hpp"
#include "sim/hammer_tap.hpp"
#include "sim/housing_path.hpp"
#include "sim/rv_contacts.hpp"
#include "sim/rv_train.hpp"
#include "sim/rv_unit.hpp"

namespace rvbench::sim {

/// The RV-20E on its bench: the train, its contacts with the housing, the housing, the sensors.
///
/// Time     one call of step() is one sample of the DAQ
/// Leaves out: what the train and the contacts leave out, the mounts of the bench
class RvBench {
 public:
  static constexpr double rate_Hz = 4960;  ///< of the article's DAQ, with four triaxial sensors
  static constexpr int sensors = 12;

  /// @throws std::invalid_argument if the bench cannot run the plant: see rv_plant_faults()
  explicit RvBench(const RvUnit& unit, const PlantSpec& plant = rv20e_bench());

  void set_supply(double frequency_Hz, bool enabled) { train_.set_supply(frequency_Hz, enabled); }
  void set_brake_torque(double torque_Nm) { train_.set_brake_torque(torque_Nm); }

  /// One DAQ sample on. @param accelerations_m_s2  size `sensors`, out
  void step(Eigen::Ref<Eigen::VectorXf> accelerations_m_s2);

  void tap_housing() { tap_.strike(); }  ///< somebody does, at the input bearing, aslant

  const RvUnit& unit() const { return unit_; }
  const RvTrain& train() const { return train_; }

 private:
  void settle();
  void step_housing(Eigen::Ref<Eigen::VectorXd> accelerations_m_s2);

  RvUnit unit_;
  RvTrain train_;
  RvContacts contacts_;
  HousingPath housing_;
  HammerTap tap_;
  Decimator decimator_;
  Eigen::VectorXd accelerations_;
  std::mt19937_64 sensor_engine_;
  std::normal_distribution<float> sensor_noise_;
};

}  // namespace rvbench::sim
