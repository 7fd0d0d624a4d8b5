#include "sim/terms/induction_motor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hal/types/units.hpp"

namespace rvbench::sim {

using units::two_pi;

InductionMotor::InductionMotor(const Params& p)
    : OneAxisTerm("induction_motor", {p.body, housing}), p_(p) {
  if (!(p.pole_pairs >= 1) || p.pole_pairs != std::floor(p.pole_pairs)) {
    throw std::invalid_argument("induction_motor: pole_pairs must be a whole number >= 1");
  }
  if (!(p.pull_out_torque_Nm > 0 && p.pull_out_slip > 0 && p.nominal_frequency_Hz > 0)) {
    throw std::invalid_argument(
        "induction_motor: pull-out torque, pull-out slip and frequency must be > 0");
  }
  if (!(p.ripple >= 0)) throw std::invalid_argument("induction_motor: ripple must be >= 0");
}

double InductionMotor::torque_Nm(const PlantState& s) const {
  if (!on_) return 0;
  return smooth_torque_Nm(s) * (1 + p_.ripple * std::cos(6 * s.z[place_]));
}

double InductionMotor::smooth_torque_Nm(double frequency_Hz, const PlantState& s) const {
  if (!on_) return 0;
  const double sync_rad_s = two_pi * frequency_Hz / p_.pole_pairs;
  const double nominal_rad_s = two_pi * p_.nominal_frequency_Hz / p_.pole_pairs;
  const double x = (sync_rad_s - speed(s)) / nominal_rad_s / p_.pull_out_slip;
  return 2 * p_.pull_out_torque_Nm * x / (1 + x * x);
}

double InductionMotor::slip_rad_s(const PlantState& s) const {
  return two_pi * supply_Hz(s) - p_.pole_pairs * speed(s);
}

double InductionMotor::fastest_rad_s(const Eigen::VectorXd& inertia) const {
  const double nominal_rad_s = two_pi * p_.nominal_frequency_Hz / p_.pole_pairs;
  const double steepest_Nms_rad = 2 * p_.pull_out_torque_Nm / p_.pull_out_slip / nominal_rad_s;
  return std::max(steepest_Nms_rad * mobility(inertia), 6 * two_pi * p_.nominal_frequency_Hz);
}

void InductionMotor::add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const {
  rates[place_] += two_pi * s.u[p_.supply];
}

const InductionMotor& motor_of(const TermSite& site) {
  const auto* motor = dynamic_cast<const InductionMotor*>(site.term);
  if (motor == nullptr) throw std::invalid_argument("motor: must be an induction_motor");
  return *motor;
}

TermGate in_a_motor() {
  return {.translation = false,
          .between_two = false,
          .reference = ReferenceKind::term,
          .reference_key = "motor",
          .reference_type = "induction_motor"};
}

TermType induction_motor() {
  return {.card = {.name = "induction_motor",
                   .effect = false,
                   .equation = "F = −2·T_k/(s/s_k + s_k/s)·(1 + ρ·cos 6φ_e), "
                               "s = (2π·f/p − v)/(2π·f_nominal/p), dφ_e/dt = 2π·f",
                   .sign = "f > 0 drives forward; above its synchronous speed it brakes",
                   .leaves_out = "electrical transients, field weakening, heating of the rotor",
                   .source = "Fitzgerald, Electric Machinery, ch. 6 (Kloss)"},
          .parameters = {{.name = "pull_out_torque",
                          .unit = UnitKind::force,
                          .min = smallest,
                          .max = unbounded,
                          .start = 3},
                         {.name = "pull_out_slip",
                          .unit = UnitKind::ratio,
                          .min = smallest,
                          .max = 1,
                          .start = 0.15},
                         {.name = "pole_pairs",
                          .unit = UnitKind::ratio,
                          .min = 1,
                          .max = 100,
                          .start = 2,
                          .fallback = 2,
                          .fitted = false},
                         {.name = "nominal_frequency",
                          .unit = UnitKind::frequency,
                          .min = 1,
                          .max = 1e4,
                          .start = 50,
                          .fallback = 50,
                          .fitted = false},
                         {.name = "ripple",
                          .unit = UnitKind::ratio,
                          .min = 0,
                          .max = 1,
                          .start = 0.02,
                          .fallback = 0}},
          .gate = {.translation = false,
                   .between_two = false,
                   .reference = ReferenceKind::input,
                   .reference_key = "supply"},
          .make = [](const TermSite& at) {
            return std::make_unique<InductionMotor>(
                InductionMotor::Params{.body = at.axis.body_a,
                                       .supply = at.input,
                                       .pole_pairs = at["pole_pairs"],
                                       .nominal_frequency_Hz = at["nominal_frequency"],
                                       .pull_out_torque_Nm = at["pull_out_torque"],
                                       .pull_out_slip = at["pull_out_slip"],
                                       .ripple = at["ripple"]});
          }};
}

}  // namespace rvbench::sim
