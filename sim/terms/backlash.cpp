#include "sim/terms/backlash.hpp"

#include <algorithm>
#include <cmath>

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

class Backlash final : public OneAxisTerm {
 public:
  explicit Backlash(const TermSite& at)
      : OneAxisTerm("backlash", at.axis), stiffness_(at["stiffness"]), half_gap_(at["gap"] / 2) {}

  double effort(const PlantState& s) const override { return stiffness_ * pressed(s); }
  double stored_energy_J(const PlantState& s) const override {
    return 0.5 * stiffness_ * pressed(s) * pressed(s);
  }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return finer_at_kinks * std::sqrt(stiffness_ * mobility(inertia));
  }

 private:
  double pressed(const PlantState& s) const {
    const double x = way(s);
    return x - std::clamp(x, -half_gap_, half_gap_);
  }

  double stiffness_, half_gap_;
};

}  // namespace

TermType backlash() {
  return {
      .card = {.name = "backlash",
               .equation = "F = k·(x − clamp(x, ±g/2)), x = q_a − q_b",
               .sign = "g >= 0 is the whole play",
               .leaves_out = "loss at impact, oil in the gap",
               .source = "Nordin & Gutman, Automatica 38(10), 1633-1649 (2002), §2.1",
               .touches = {{Ledger::transient, "torque around reversals"},
                           {Ledger::broadband, "impacts, twice per crossing of zero torque"},
                           {Ledger::quasi_static, "angle lag that jumps with the torque's sign"}},
               .must_not_touch = {{Ledger::shaft, "anything while the torque keeps its sign"}},
               .mimics = {"stiffness_hysteresis", "looseness", "coulomb_friction"},
               .experiment = "slow torque sine through zero: a loop of ±3 % of the rated torque"},
      .parameters = {{.name = "stiffness",
                      .unit = UnitKind::stiffness,
                      .min = 0,
                      .max = unbounded,
                      .start = 1,
                      .fitted = false},
                     {.name = "gap",
                      .unit = UnitKind::coordinate,
                      .min = 0,
                      .max = unbounded,
                      .start = 0.02}},
      .gate = {.in_place_of = "spring"},  // play is in a joint that would be elastic without it
      .make = [](const TermSite& at) { return std::make_unique<Backlash>(at); },
      .edit =
          [](PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
            return replace_or_append(std::move(plant), "backlash", site, parameters);
          }};
}

}  // namespace rvbench::sim
