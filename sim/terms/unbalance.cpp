#include "sim/terms/unbalance.hpp"

#include <cmath>

namespace rvbench::sim {
namespace {

class Unbalance final : public OneAxisTerm {
 public:
  explicit Unbalance(const TermSite& at)
      : OneAxisTerm("unbalance", at.axis),
        rotor_(at.body),
        amount_kgm_(at["amount"]),
        phase_rad_(at["phase"]) {}

  double effort(const PlantState& s) const override {
    return -amount_kgm_ * s.v[rotor_] * s.v[rotor_] * std::cos(s.q[rotor_] + phase_rad_);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const override {
    add_order(turns[rotor_], orders);
  }

 private:
  int rotor_;
  double amount_kgm_, phase_rad_;
};

}  // namespace

TermType unbalance() {
  return {.card = {.name = "unbalance",
                   .equation = "F = −U·ω²·cos(θ + φ)",
                   .sign = "U >= 0 pushes outward at the angle −φ",
                   .leaves_out = "the rotor's own reaction, its angular acceleration",
                   .source = "Rao, Mechanical Vibrations, ch. 3.7",
                   .touches = {{Ledger::shaft, "order 1, with the square of speed, radial"}},
                   .must_not_touch = {{Ledger::shaft, "order 2 and above; growth with load"},
                                      {Ledger::quasi_static, "means"}},
                   .mimics = {"misalignment", "gear_eccentricity"},
                   .experiment = "trial mass; run-up"},
          .parameters = {{.name = "amount",
                          .unit = UnitKind::mass_offset,
                          .min = 0,
                          .max = unbounded,
                          .start = 1e-5},
                         {.name = "phase",
                          .unit = UnitKind::angle,
                          .min = -unbounded,
                          .max = unbounded,
                          .start = 0,
                          .fallback = 0,
                          .is_phase = true}},
          .gate = {.rotation = false,
                   .between_two = false,
                   .reference = ReferenceKind::body,
                   .reference_key = "rotor"},
          .make = [](const TermSite& at) { return std::make_unique<Unbalance>(at); }};
}

}  // namespace rvbench::sim
