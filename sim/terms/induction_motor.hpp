#pragma once

#include "sim/physics_term.hpp"

namespace rvbench::sim {

/// Asynchronous motor on a V/f inverter: torque from slip, plus the inverter's sixth-harmonic
/// ripple.
///
///     s = (ω_sync − ω) / ω_nominal,  τ = 2·τ_k / (s/s_k + s_k/s) · (1 + ρ·cos 6φ_e)
///     ω_sync = 2π·f / p,  ω_nominal = 2π·f_nominal / p,  dφ_e/dt = 2π·f
///
/// With V/f control the torque over slip *speed* does not depend on f, hence ω_nominal below.
/// Leaves out: electrical transients, field weakening, heating of the rotor.
/// Source: Kloss formula, Fitzgerald, Electric Machinery, ch. 6; ripple: 5th and 7th currents
class InductionMotor final : public PhysicsTerm {
 public:
  struct Params {
    int body = 0;
    int pole_pairs = 2;
    double nominal_frequency_Hz = 50;
    double pull_out_torque_Nm = 0;  ///< τ_k > 0
    double pull_out_slip = 0;       ///< s_k > 0
    double ripple = 0;              ///< ρ, relative, >= 0
  };

  /// @throws std::invalid_argument naming the first parameter out of range
  explicit InductionMotor(const Params& p);

  void set_supply(double frequency_Hz, bool enabled);
  void advance(double dt_s);  ///< turns the electrical angle on

  std::string_view name() const override { return "induction_motor"; }
  void add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;
  double stored_energy_J(const PlantState&) const override { return 0; }
  double dissipated_power_W(const PlantState&) const override { return 0; }
  double supplied_power_W(const PlantState& s) const override;

  double torque_Nm(double speed_rad_s) const;

 private:
  Params p_;
  double frequency_Hz_ = 0;
  bool enabled_ = false;
  double electrical_angle_rad_ = 0;
  double ripple_factor_ = 1;
};

}  // namespace rvbench::sim
