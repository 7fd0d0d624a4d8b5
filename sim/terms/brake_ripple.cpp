#include "sim/terms/brake_ripple.hpp"

#include <cmath>

#include "sim/retuning.hpp"
#include "sim/terms/one_axis_term.hpp"

namespace rvbench::sim {
namespace {

class BrakeRipple final : public OneAxisTerm {
 public:
  explicit BrakeRipple(const TermSite& at)
      : OneAxisTerm("brake_ripple", at.axis),
        brake_(at.input),
        depth_(at["depth"]),
        phase_rad_(at["phase"]),
        per_turn_(at["per_turn"]) {}

  double effort(const PlantState& s) const override {
    return -depth_ * s.u[brake_] * std::cos(per_turn_ * way(s) + phase_rad_);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const override {
    add_order(per_turn_ * turns[axis().body_a], orders);
  }

 private:
  int brake_;  ///< the input that pushes the body: its place in PlantState::u
  double depth_, phase_rad_, per_turn_;
};

}  // namespace

TermType brake_ripple() {
  return {
      .card = {.name = "brake_ripple",
               .equation = "F = −ρ·u·cos(m·θ + φ), u the brake's push, m = 1 or 2 per turn",
               .sign = "ρ >= 0 brakes more where the cosine is 1",
               .leaves_out = "torque that depends on speed, poles that come more often, what is "
                             "left of them without current",
               .source = "assumed, without a source: a wave of 0.5 to 3 % of the torque",
               .touches = {{Ledger::shaft, "order m of the brake's turn, in proportion to load"}},
               .must_not_touch = {{Ledger::shaft, "order m of the brake's turn without load"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"misalignment", "unbalance"},
               .experiment = "brake current off and on at one speed: it goes and comes at once, "
                             "what the reducer's errors bring stays in part"},
      .parameters = {{.name = "depth", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.02},
                     phase_card("phase"),
                     {.name = "per_turn",
                      .unit = UnitKind::ratio,
                      .min = 1,
                      .max = 2,
                      .start = 1,
                      .choices = {{1, "once a turn"}, {2, "twice a turn"}}}},
      .gate = {.translation = false,
               .between_two = false,
               .reference = ReferenceKind::push,
               .reference_key = "brake"},
      .make = [](const TermSite& at) { return std::make_unique<BrakeRipple>(at); },
      .shows_in = {ComparedBy::orders}};
}

}  // namespace rvbench::sim
