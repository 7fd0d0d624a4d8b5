#include "sim/terms/cubic_stiffness.hpp"

namespace rvbench::sim {
namespace {

class CubicStiffness final : public OneAxisTerm {
 public:
  explicit CubicStiffness(const TermSite& at)
      : OneAxisTerm("cubic_stiffness", at.axis), stiffness_(at["stiffness"]) {}

  double effort(const PlantState& s) const override {
    const double x = way(s);
    return stiffness_ * x * x * x;
  }
  double stored_energy_J(const PlantState& s) const override {
    const double x = way(s);
    return stiffness_ * 0.25 * x * x * x * x;
  }

 private:
  double stiffness_;
};

}  // namespace

TermType cubic_stiffness() {
  return {.card = {.name = "cubic_stiffness",
                   .equation = "F = k_3·x³",
                   .sign = "k_3 > 0 hardens, < 0 softens",
                   .leaves_out = "even powers",
                   .source = "Kovacic & Brennan, The Duffing Equation, ch. 1",
                   .touches = {{Ledger::fixed_frequency,
                                "resonance that bends with amplitude, odd harmonics"}},
                   .must_not_touch = {{Ledger::fixed_frequency, "even harmonics, mean shift"}},
                   .mimics = {"nonlinear_damping", "looseness", "backlash"},
                   .experiment =
                       "amplitude steps: the resonance moves with the square of the amplitude"},
          .parameters = {{.name = "stiffness",
                          .unit = UnitKind::cubic_stiffness,
                          .min = -unbounded,
                          .max = unbounded,
                          .start = 0.05}},
          .make = [](const TermSite& at) { return std::make_unique<CubicStiffness>(at); }};
}

}  // namespace rvbench::sim
