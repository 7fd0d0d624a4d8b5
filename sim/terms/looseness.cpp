#include "sim/terms/looseness.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::sim {
namespace {

class Looseness final : public OneAxisTerm {
 public:
  explicit Looseness(const TermSite& at)
      : OneAxisTerm("looseness", at.axis),
        change_(at["stiffness_change"]),
        threshold_(at["threshold"]) {}

  double effort(const PlantState& s) const override { return change_ * beyond(s); }
  double stored_energy_J(const PlantState& s) const override {
    return 0.5 * change_ * beyond(s) * beyond(s);
  }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return finer_at_kinks * std::sqrt(std::abs(change_) * mobility(inertia));
  }

 private:
  double beyond(const PlantState& s) const { return std::max(way(s) - threshold_, 0.0); }

  double change_, threshold_;
};

}  // namespace

TermType looseness() {
  return {.card = {.name = "looseness",
                   .equation = "F = Δk·max(x − x_0, 0)",
                   .sign = "Δk > 0 is stiffer beyond x_0, < 0 softer",
                   .leaves_out = "rubbing, loss at impact",
                   .source = "Muszynska & Goldman, Chaos, Solitons & Fractals 5(9), 1683-1704 "
                             "(1995)",
                   .touches = {{Ledger::shaft, "orders 1/2 and 1/3, many harmonics, mean shift"},
                               {Ledger::fixed_frequency, "resonance that moves with amplitude"}},
                   .must_not_touch = {{Ledger::shaft, "amplitudes below the threshold"}},
                   .mimics = {"quadratic_stiffness", "backlash", "crank_eccentricity"},
                   .experiment = "amplitude steps: below a threshold nothing changes; 72 s of "
                                 "record part order 1/3 from 40/121"},
          .parameters = {{.name = "stiffness_change",
                          .unit = UnitKind::stiffness,
                          .min = -unbounded,
                          .max = unbounded,
                          .start = 0.1},
                         {.name = "threshold",
                          .unit = UnitKind::coordinate,
                          .min = -unbounded,
                          .max = unbounded,
                          .start = 0.5}},
          .gate = {.beside = "spring"},
          .make = [](const TermSite& at) { return std::make_unique<Looseness>(at); }};
}

}  // namespace rvbench::sim
