#include "sim/terms/quadratic_stiffness.hpp"

namespace rvbench::sim {
namespace {

class QuadraticStiffness final : public OneAxisTerm {
 public:
  explicit QuadraticStiffness(const TermSite& at)
      : OneAxisTerm("quadratic_stiffness", at.axis), stiffness_(at["stiffness"]) {}

  double effort(const PlantState& s) const override {
    const double x = way(s);
    return stiffness_ * x * x;
  }
  double stored_energy_J(const PlantState& s) const override {
    const double x = way(s);
    return stiffness_ * x * x * x / 3;
  }

 private:
  double stiffness_;
};

}  // namespace

TermType quadratic_stiffness() {
  return {
      .card = {.name = "quadratic_stiffness",
               .equation = "F = k_2·x²",
               .sign = "k_2 > 0 is stiffer for x > 0",
               .leaves_out = "odd powers; unbounded beyond where it turns the stiffness negative",
               .source = "Kovacic & Brennan, The Duffing Equation, ch. 7",
               .touches = {{Ledger::fixed_frequency, "even harmonics, mean shift with amplitude"}},
               .must_not_touch = {{Ledger::fixed_frequency, "odd harmonics"}},
               .mimics = {"looseness", "torque_offset"},
               .experiment = "amplitude steps: the mean shifts with the square of the amplitude"},
      .parameters = {{.name = "stiffness",
                      .unit = UnitKind::quadratic_stiffness,
                      .min = -unbounded,
                      .max = unbounded,
                      .start = 0.05}},
      .make = [](const TermSite& at) { return std::make_unique<QuadraticStiffness>(at); }};
}

}  // namespace rvbench::sim
