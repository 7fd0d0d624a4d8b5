#include "sim/terms/torque_offset.hpp"

namespace rvbench::sim {
namespace {

class TorqueOffset final : public OneAxisTerm {
 public:
  explicit TorqueOffset(const TermSite& at)
      : OneAxisTerm("torque_offset", at.axis), level_(at["level"]) {}

  double effort(const PlantState&) const override { return level_; }
  double supplied_power_W(const PlantState& s) const override { return -level_ * speed(s); }

 private:
  double level_;
};

}  // namespace

TermType torque_offset() {
  return {.card = {.name = "torque_offset",
                   .equation = "F = T_0",
                   .sign = "T_0 > 0 pulls back, in both directions of motion",
                   .leaves_out = "drift",
                   .source = "Gautier & Poignet, Control Eng. Practice 9, 139-148 (2001)",
                   .touches = {{Ledger::quasi_static, "torque mean, even in the direction"}},
                   .must_not_touch = {{Ledger::shaft, "all lines"},
                                      {Ledger::quasi_static, "growth with speed or load"}},
                   .mimics = {"coulomb_friction", "asymmetric_friction"},
                   .experiment = "zero check at standstill; reverse"},
          .parameters = {{.name = "level",
                          .unit = UnitKind::force,
                          .min = -unbounded,
                          .max = unbounded,
                          .start = 0.05}},
          .make = [](const TermSite& at) { return std::make_unique<TorqueOffset>(at); }};
}

}  // namespace rvbench::sim
