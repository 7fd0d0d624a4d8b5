#include "sim/terms/asymmetric_friction.hpp"

#include <algorithm>
#include <cmath>

#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {
namespace {

class AsymmetricFriction final : public DryFriction {
 public:
  explicit AsymmetricFriction(const TermSite& at)
      : DryFriction("asymmetric_friction", at.axis, at["creep_speed"]),
        level_(at["level"]),
        damping_(at["damping"]) {}

  Limits limits(const PlantState& s) const override {
    const double v = std::abs(speed(s));
    return {std::max(level_, 0.0) + std::max(damping_, 0.0) * v,
            std::max(-level_, 0.0) + std::max(-damping_, 0.0) * v};
  }

 private:
  double level_, damping_;
};

}  // namespace

TermType asymmetric_friction() {
  return {
      .card = {.name = "asymmetric_friction",
               .equation = "F = (|c| + |b|·|v|)·tanh(v/v_ε), c and b where v has their sign",
               .sign = "> 0 brakes forward motion only, < 0 backward motion only",
               .leaves_out = "what the two directions share",
               .source = "Armstrong-Hélouvry et al., Automatica 30(7), 1083-1138 (1994), §2.1",
               .touches = {{Ledger::quasi_static, "torque mean, even in the direction"}},
               .must_not_touch = {{Ledger::quasi_static, "torque at standstill"},
                                  {Ledger::shaft, "lines of the shaft at constant speed"}},
               .mimics = {"torque_offset", "coulomb_friction"},
               .experiment = "both directions at three speeds and at standstill: an offset is the "
                             "same at all of them"},
      .parameters = {{.name = "level",
                      .unit = UnitKind::force,
                      .min = -unbounded,
                      .max = unbounded,
                      .start = 0.03,
                      .fallback = 0},
                     {.name = "damping",
                      .unit = UnitKind::damping,
                      .min = -unbounded,
                      .max = unbounded,
                      .start = 0.03,
                      .fallback = 0},
                     creep_speed_card()},
      .gate = {.one_way_like = "coulomb_friction"},
      .make = [](const TermSite& at) { return std::make_unique<AsymmetricFriction>(at); }};
}

}  // namespace rvbench::sim
