#include "sim/terms/induction_motor.hpp"

#include <cmath>
#include <stdexcept>

#include "hal/types/units.hpp"

namespace rvbench::sim {

InductionMotor::InductionMotor(const Params& p) : p_(p) {
  if (p.pole_pairs < 1) throw std::invalid_argument("induction_motor: pole_pairs must be >= 1");
  if (!(p.pull_out_torque_Nm > 0 && p.pull_out_slip > 0 && p.nominal_frequency_Hz > 0)) {
    throw std::invalid_argument(
        "induction_motor: pull-out torque, pull-out slip and frequency must be > 0");
  }
  if (!(p.ripple >= 0)) throw std::invalid_argument("induction_motor: ripple must be >= 0");
}

void InductionMotor::set_supply(double frequency_Hz, bool enabled) {
  frequency_Hz_ = frequency_Hz;
  enabled_ = enabled;
}

void InductionMotor::advance(double dt_s) {
  electrical_angle_rad_ =
      std::remainder(electrical_angle_rad_ + units::two_pi * frequency_Hz_ * dt_s, units::two_pi);
  ripple_factor_ = 1 + p_.ripple * std::cos(6 * electrical_angle_rad_);
}

double InductionMotor::torque_Nm(double speed_rad_s) const {
  if (!enabled_) return 0;
  const double sync_rad_s = units::two_pi * frequency_Hz_ / p_.pole_pairs;
  const double nominal_rad_s = units::two_pi * p_.nominal_frequency_Hz / p_.pole_pairs;
  const double x = (sync_rad_s - speed_rad_s) / nominal_rad_s / p_.pull_out_slip;
  return 2 * p_.pull_out_torque_Nm * x / (1 + x * x) * ripple_factor_;
}

void InductionMotor::add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  f[p_.body] += torque_Nm(s.v[p_.body]);
}

double InductionMotor::supplied_power_W(const PlantState& s) const {
  return torque_Nm(s.v[p_.body]) * s.v[p_.body];
}

}  // namespace rvbench::sim
