#include "sim/terms/coulomb_friction.hpp"

#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {
namespace {

class CoulombFriction final : public DryFriction {
 public:
  explicit CoulombFriction(const TermSite& at)
      : DryFriction("coulomb_friction", at.axis, at["creep_speed"]), level_(at["level"]) {}

  Limits limits(const PlantState&) const override { return {level_, level_}; }

 private:
  double level_;
};

}  // namespace

TermType coulomb_friction() {
  return {
      .card = {.name = "coulomb_friction",
               .equation = "F = T_c·tanh(v/v_ε)",
               .sign = "T_c >= 0 opposes motion",
               .leaves_out = "stiction; dependence on speed, load and temperature",
               .source = "Armstrong-Hélouvry et al., Automatica 30(7), 1083-1138 (1994), §2",
               .touches = {{Ledger::quasi_static, "torque mean, the same at all speeds and loads"},
                           {Ledger::transient, "jump of torque where the speed turns round"}},
               .must_not_touch = {{Ledger::shaft, "lines of the shaft at constant speed"},
                                  {Ledger::quasi_static, "growth with load"}},
               .mimics = {"torque_offset", "stribeck_friction", "asymmetric_friction"},
               .experiment = "reverse: an offset is even in the direction, friction odd"},
      .parameters =
          {{.name = "level", .unit = UnitKind::force, .min = 0, .max = unbounded, .start = 0.1},
           creep_speed_card()},
      .make = [](const TermSite& at) { return std::make_unique<CoulombFriction>(at); }};
}

}  // namespace rvbench::sim
