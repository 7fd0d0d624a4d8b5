#pragma once

#include <cmath>

#include "sim/term_library.hpp"
#include "sim/terms/one_axis_term.hpp"

namespace rvbench::sim {

/// The sign of a speed with the jump at standstill spread over ±creep: below it a body creeps
/// where it would stick.
inline double creeping_sign(double speed, double creep_speed) {
  return std::tanh(speed / creep_speed);
}

/// Friction that turns round with the speed, as steeply as creep_speed says.
///
///     F = L·tanh(v/v_ε),   L = L₊ for v > 0, L₋ for v < 0
///
/// Kept apart from other terms so that the integrator can solve for the speed at which it holds:
/// with a short creep_speed no explicit step would be stable.
class DryFriction : public OneAxisTerm {
 public:
  struct Limits {
    double forward, backward;  ///< N or N·m, >= 0
  };

  /// @throws std::invalid_argument if creep_speed is not > 0
  DryFriction(std::string_view name, Axis axis, double creep_speed);

  virtual Limits limits(const PlantState& s) const = 0;

  double creep_speed() const { return creep_speed_; }
  double effort(const PlantState& s) const final {
    const double v = speed(s);
    const Limits l = limits(s);
    return (v > 0 ? l.forward : l.backward) * creeping_sign(v, creep_speed_);
  }
  double dissipated_power_W(const PlantState& s) const final { return effort(s) * speed(s); }

 private:
  double creep_speed_;
};

/// v_ε, as every type of dry friction asks for it: chosen beforehand, well below the speeds that
/// matter and above the noise of a measured speed.
ParameterCard creep_speed_card();

}  // namespace rvbench::sim
