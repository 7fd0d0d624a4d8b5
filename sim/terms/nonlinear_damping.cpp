#include "sim/terms/nonlinear_damping.hpp"

#include <cmath>

namespace rvbench::sim {
namespace {

class NonlinearDamping final : public OneAxisTerm {
 public:
  explicit NonlinearDamping(const TermSite& at)
      : OneAxisTerm("nonlinear_damping", at.axis), damping_(at["damping"]) {}

  double effort(const PlantState& s) const override {
    return damping_ * std::abs(speed(s)) * speed(s);
  }
  double dissipated_power_W(const PlantState& s) const override { return effort(s) * speed(s); }

 private:
  double damping_;
};

}  // namespace

TermType nonlinear_damping() {
  return {.card = {.name = "nonlinear_damping",
                   .equation = "F = c_2·|v|·v",
                   .sign = "c_2 >= 0 opposes motion",
                   .leaves_out = "damping that grows with the way",
                   .source = "Nayfeh & Mook, Nonlinear Oscillations, ch. 3.3",
                   .touches = {{Ledger::fixed_frequency, "width of a resonance, by amplitude"},
                               {Ledger::quasi_static, "torque mean, convex in speed"}},
                   .must_not_touch = {{Ledger::fixed_frequency, "place of the resonance"},
                                      {Ledger::quasi_static, "growth with load"}},
                   .mimics = {"displacement_damping", "coulomb_friction", "viscous_friction"},
                   .experiment = "free decay from two amplitudes"},
          .parameters = {{.name = "damping",
                          .unit = UnitKind::quadratic_damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.02}},
          .make = [](const TermSite& at) { return std::make_unique<NonlinearDamping>(at); }};
}

}  // namespace rvbench::sim
