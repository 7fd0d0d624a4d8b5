#include "sim/terms/saturation.hpp"

#include <algorithm>

namespace rvbench::sim {
namespace {

class Saturation final : public OneAxisTerm {
 public:
  explicit Saturation(const TermSite& at)
      : OneAxisTerm("saturation", at.axis), input_(at.input), limit_(at["limit"]) {}

  double effort(const PlantState& s) const override {
    return s.u[input_] - std::clamp(s.u[input_], -limit_, limit_);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }

 private:
  int input_;
  double limit_;
};

}  // namespace

TermType saturation() {
  return {.card = {.name = "saturation",
                   .equation = "F = u − clamp(u, ±L)",
                   .sign = "L > 0; what u asks for beyond it is not given",
                   .leaves_out = "a limit that falls with speed, recovery time",
                   .source = "Tarbouriech et al., Stability and Stabilization of Linear Systems "
                             "with Saturating Actuators, ch. 1",
                   .touches = {{Ledger::transient, "peaks of the drive, odd harmonics there"}},
                   .must_not_touch = {{Ledger::quasi_static, "anything while u stays below L"}},
                   .mimics = {"cubic_stiffness", "nonlinear_damping"},
                   .experiment = "steps of growing height: nothing more is gained above L"},
          .parameters = {{.name = "limit",
                          .unit = UnitKind::force,
                          .min = smallest,
                          .max = unbounded,
                          .start = 0.8}},
          .gate = {.reference = ReferenceKind::input, .reference_key = "input"},
          .make = [](const TermSite& at) { return std::make_unique<Saturation>(at); }};
}

}  // namespace rvbench::sim
