#include "sim/terms/misalignment.hpp"

#include <cmath>

#include "sim/retuning.hpp"

namespace rvbench::sim {
namespace {

class Misalignment final : public OneAxisTerm {
 public:
  explicit Misalignment(const TermSite& at)
      : OneAxisTerm("misalignment", at.axis),
        stiffness_(at["stiffness"]),
        phase_rad_(at["phase"]),
        per_turn_(at["per_turn"]) {}

  double effort(const PlantState& s) const override {
    return stiffness_ * way(s) * std::cos(per_turn_ * s.q[axis().body_a] + phase_rad_);
  }
  // The stiffness changes as the shaft turns: what it gives back is not what it took.
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const override {
    add_order(per_turn_ * turns[axis().body_a], orders);
  }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return std::sqrt(std::abs(stiffness_) * mobility(inertia));
  }

 private:
  double stiffness_, phase_rad_, per_turn_;
};

}  // namespace

TermType misalignment() {
  return {.card = {.name = "misalignment",
                   .equation = "F = κ·x·cos(m·θ_a + φ), x = q_a − q_b, m = 2 or 4 per turn",
                   .sign = "κ >= 0 stiffens at the angle −φ/m",
                   .leaves_out =
                       "radial and axial forces, the line at order 1, multiples above the fourth, "
                       "wear of the coupling",
                   .source = "Xu & Marangoni, J. Sound Vib. 176(5), 663-679 (1994)",
                   .touches = {{Ledger::shaft, "order m, growing with the torque"}},
                   .must_not_touch = {{Ledger::shaft, "order m without torque"},
                                      {Ledger::quasi_static, "means"}},
                   .mimics = {"unbalance", "inverter_ripple"},
                   .experiment = "shim the coupling; slip parts 2·f_e/p from order 2"},
          .parameters = {{.name = "stiffness",
                          .unit = UnitKind::stiffness,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.05},
                         phase_card("phase"),
                         {.name = "per_turn",
                          .unit = UnitKind::ratio,
                          .min = 2,
                          .max = 4,
                          .start = 2,
                          .fallback = 2,
                          .choices = {{2, "twice a turn"}, {4, "four times a turn"}}}},
          .gate = {.translation = false, .on_one = false},
          .make = [](const TermSite& at) { return std::make_unique<Misalignment>(at); }};
}

}  // namespace rvbench::sim
