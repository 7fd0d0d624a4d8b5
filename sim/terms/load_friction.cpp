#include "sim/terms/load_friction.hpp"

#include <cmath>

#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {
namespace {

class LoadFriction final : public DryFriction {
 public:
  explicit LoadFriction(const TermSite& at)
      : DryFriction("load_friction", at.axis, at["creep_speed"]),
        load_(at.term),
        coefficient_(at["coefficient"]) {}

  Limits limits(const PlantState& s) const override {
    const double level = coefficient_ * std::abs(load_->effort(s));
    return {level, level};
  }

 private:
  const PhysicsTerm* load_;
  double coefficient_;
};

}  // namespace

TermType load_friction() {
  return {.card = {.name = "load_friction",
                   .equation = "F = μ·|F_load|·tanh(v/v_ε)",
                   .sign = "μ >= 0 opposes motion",
                   .leaves_out = "efficiency that differs between driving and being driven",
                   .source = "Bittencourt & Gunnarsson, J. Dyn. Syst. Meas. Control 134(5) (2012)",
                   .touches = {{Ledger::quasi_static, "torque mean, in proportion to load"},
                               {Ledger::transient, "jump at reversal that grows with load"}},
                   .must_not_touch = {{Ledger::quasi_static, "no-load torque"}},
                   .mimics = {"coulomb_friction", "stiffness_hysteresis"},
                   .experiment =
                       "known weight against a gain error of the sensor; reversal under load"},
          .parameters =
              {{.name = "coefficient", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.05},
               creep_speed_card()},
          .gate = {.reference = ReferenceKind::term, .reference_key = "load"},
          .make = [](const TermSite& at) { return std::make_unique<LoadFriction>(at); }};
}

}  // namespace rvbench::sim
