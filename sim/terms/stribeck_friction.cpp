#include "sim/terms/stribeck_friction.hpp"

#include <cmath>

#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {
namespace {

class StribeckFriction final : public DryFriction {
 public:
  explicit StribeckFriction(const TermSite& at)
      : DryFriction("stribeck_friction", at.axis, at["creep_speed"]),
        excess_(at["excess"]),
        stribeck_speed_(at["stribeck_speed"]),
        exponent_(at["exponent"]) {}

  Limits limits(const PlantState& s) const override {
    const double share = std::abs(speed(s)) / stribeck_speed_;
    const double level =
        excess_ * std::exp(exponent_ == 2 ? -share * share : -std::pow(share, exponent_));
    return {level, level};
  }

 private:
  double excess_, stribeck_speed_, exponent_;
};

}  // namespace

TermType stribeck_friction() {
  return {
      .card = {.name = "stribeck_friction",
               .equation = "F = ΔT·exp(−|v/v_s|^δ)·tanh(v/v_ε)",
               .sign = "ΔT >= 0 opposes motion, most of all at creep",
               .leaves_out = "presliding, delay of the film",
               .source = "Armstrong-Hélouvry et al., Automatica 30(7), 1083-1138 (1994), §2.1",
               .touches = {{Ledger::quasi_static, "torque mean at creep speeds"},
                           {Ledger::transient, "torque at start and stop"}},
               .must_not_touch = {{Ledger::quasi_static, "torque mean well above v_s"}},
               .mimics = {"coulomb_friction", "shear_thinning"},
               .experiment = "creep at 30-240 rpm, start and stop"},
      .parameters =
          {{.name = "excess", .unit = UnitKind::force, .min = 0, .max = unbounded, .start = 0.05},
           {.name = "stribeck_speed",
            .unit = UnitKind::speed,
            .min = smallest,
            .max = unbounded,
            .start = 0.1},
           {.name = "exponent",
            .unit = UnitKind::ratio,
            .min = 0.5,
            .max = 2,
            .start = 2,
            .fallback = 2,
            .fitted = false},
           creep_speed_card()},
      .make = [](const TermSite& at) { return std::make_unique<StribeckFriction>(at); }};
}

}  // namespace rvbench::sim
