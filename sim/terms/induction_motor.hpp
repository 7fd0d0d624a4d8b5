#pragma once

#include <cmath>

#include "sim/term_library.hpp"
#include "sim/term_memory.hpp"

namespace rvbench::sim {

/// Asynchronous motor on a V/f inverter: torque from slip, plus the inverter's sixth-harmonic
/// ripple. The plant's input says the inverter's output frequency f.
///
///     s = (ω_sync − ω) / ω_nominal,  τ = 2·τ_k / (s/s_k + s_k/s) · (1 + ρ·cos 6φ_e)
///     ω_sync = 2π·f / p,  ω_nominal = 2π·f_nominal / p,  dφ_e/dt = 2π·f
///
/// With V/f control the torque over slip *speed* does not depend on f, hence ω_nominal below.
/// Leaves out: electrical transients, field weakening, heating of the rotor.
/// Source: Kloss formula, Fitzgerald, Electric Machinery, ch. 6; ripple: 5th and 7th currents
class InductionMotor final : public OneAxisTerm, public TermMemory {
 public:
  struct Params {
    int body = 0;
    int supply = 0;  ///< the input that says f [Hz]: its place in PlantState::u
    double pole_pairs = 2;
    double nominal_frequency_Hz = 50;
    double pull_out_torque_Nm = 0;  ///< τ_k > 0
    double pull_out_slip = 0;       ///< s_k > 0
    double ripple = 0;              ///< ρ, relative, >= 0
  };

  /// @throws std::invalid_argument naming the first parameter out of range
  explicit InductionMotor(const Params& p);

  void switch_on(bool on) { on_ = on; }  ///< the inverter's output; without it the motor coasts
  double torque_Nm(const PlantState& s) const;

  /// Without the inverter's ripple, at another output frequency than the present one.
  double smooth_torque_Nm(double frequency_Hz, const PlantState& s) const;
  double smooth_torque_Nm(const PlantState& s) const { return smooth_torque_Nm(supply_Hz(s), s); }
  double supply_Hz(const PlantState& s) const { return s.u[p_.supply]; }
  /// How fast the field runs past the rotor, in electrical rad/s: 2π·f − p·ω.
  double slip_rad_s(const PlantState& s) const;

  double effort(const PlantState& s) const override { return -torque_Nm(s); }
  double supplied_power_W(const PlantState& s) const override { return torque_Nm(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override;
  double rhythm_Hz(const PlantState& s) const override {
    return p_.ripple == 0 ? 0 : 6 * std::abs(s.u[p_.supply]);
  }

  Eigen::Index size() const override { return 1; }
  void place(Eigen::Index first) override { place_ = first; }
  bool is_clock() const override { return true; }
  void add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const override;

 private:
  Params p_;
  bool on_ = true;
  Eigen::Index place_ = 0;  ///< of φ_e
};

TermType induction_motor();

/// The motor that a term's site refers to.
/// @throws std::invalid_argument if it is none
const InductionMotor& motor_of(const TermSite& site);

/// Where a term may act that is part of what an induction motor makes: beside it.
TermGate in_a_motor();

}  // namespace rvbench::sim
