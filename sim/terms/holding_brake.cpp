#include "sim/terms/holding_brake.hpp"

#include <cmath>

#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {
namespace {

class HoldingBrake final : public DryFriction {
 public:
  explicit HoldingBrake(const TermSite& at)
      : DryFriction("holding_brake", at.axis, at["creep_speed"]), torque_(at.input) {}

  Limits limits(const PlantState& s) const override {
    const double level = std::abs(s.u[torque_]);
    return {level, level};
  }

 private:
  int torque_;  ///< its place in PlantState::u
};

}  // namespace

TermType holding_brake() {
  return {.card = {.name = "holding_brake",
                   .effect = false,
                   .equation = "F = |u|·tanh(v/v_ε)",
                   .sign = "any u opposes motion",
                   .leaves_out = "more torque at standstill than in slip, the time that it takes "
                                 "to grip",
                   .source = "Armstrong-Hélouvry et al., Automatica 30(7), 1083-1138 (1994), §2"},
          .parameters = {creep_speed_card()},
          .gate = {.translation = false,
                   .between_two = false,
                   .reference = ReferenceKind::input,
                   .reference_key = "told"},
          .make = [](const TermSite& at) { return std::make_unique<HoldingBrake>(at); }};
}

}  // namespace rvbench::sim
