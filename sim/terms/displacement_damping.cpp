#include "sim/terms/displacement_damping.hpp"

#include "sim/terms/one_axis_term.hpp"

namespace rvbench::sim {
namespace {

class DisplacementDamping final : public OneAxisTerm {
 public:
  explicit DisplacementDamping(const TermSite& at)
      : OneAxisTerm("displacement_damping", at.axis),
        damping_(at["damping"] / (at["at_way"] * at["at_way"])) {}

  double effort(const PlantState& s) const override {
    return damping_ * way(s) * way(s) * speed(s);
  }
  double dissipated_power_W(const PlantState& s) const override { return effort(s) * speed(s); }

 private:
  double damping_;
};

}  // namespace

TermType displacement_damping() {
  return {.card = {.name = "displacement_damping",
                   .equation = "F = c·(x/x_0)²·v",
                   .sign = "c >= 0 opposes motion",
                   .leaves_out = "damping that grows with speed",
                   .source = "Nayfeh & Mook, Nonlinear Oscillations, ch. 3.3",
                   .touches = {{Ledger::fixed_frequency, "width of a resonance, by amplitude"}},
                   .must_not_touch = {{Ledger::fixed_frequency, "place of the resonance"},
                                      {Ledger::quasi_static, "torque mean"}},
                   .mimics = {"nonlinear_damping", "stiffness_hysteresis", "viscous_friction"},
                   .experiment =
                       "the same amplitude at two frequencies: this one grows with the first power "
                       "of frequency, nonlinear_damping with the second"},
          .parameters = {{.name = "damping",
                          .unit = UnitKind::damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.02},
                         {.name = "at_way",
                          .unit = UnitKind::coordinate,
                          .min = smallest,
                          .max = unbounded,
                          .start = 1,
                          .fitted = false}},
          .make = [](const TermSite& at) { return std::make_unique<DisplacementDamping>(at); }};
}

}  // namespace rvbench::sim
