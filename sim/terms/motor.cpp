#include "sim/terms/motor.hpp"

namespace rvbench::sim {
namespace {

class Motor final : public OneAxisTerm {
 public:
  explicit Motor(const TermSite& at)
      : OneAxisTerm("motor", at.axis),
        input_(at.input),
        constant_(at["constant"]),
        resistance_ohm_(at["resistance"]) {}

  double effort(const PlantState& s) const override { return -constant_ * current_A(s); }
  double dissipated_power_W(const PlantState& s) const override {
    return resistance_ohm_ * current_A(s) * current_A(s);
  }
  double supplied_power_W(const PlantState& s) const override { return s.u[input_] * current_A(s); }
  void add_linear(Eigen::MatrixXd&, Eigen::MatrixXd& damping) const override {
    add_between(damping, constant_ * constant_ / resistance_ohm_);
  }
  void add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override {
    give(-constant_ * s.u[input_] / resistance_ohm_, f);
  }

 private:
  double current_A(const PlantState& s) const {
    return (s.u[input_] - constant_ * speed(s)) / resistance_ohm_;
  }

  int input_;
  double constant_, resistance_ohm_;
};

}  // namespace

TermType motor() {
  return {.card = {.name = "motor",
                   .effect = false,
                   .equation = "F = −K·(u − K·v)/R",
                   .sign = "u > 0 and K > 0 push forward",
                   .leaves_out = "inductance, iron losses, cogging",
                   .source = "Fitzgerald, Electric Machinery, ch. 7"},
          .parameters = {{.name = "constant",
                          .unit = UnitKind::motor_constant,
                          .min = -unbounded,
                          .max = unbounded,
                          .start = 1},
                         {.name = "resistance",
                          .unit = UnitKind::resistance,
                          .min = smallest,
                          .max = unbounded,
                          .start = 1}},
          .gate = {.reference = ReferenceKind::input, .reference_key = "voltage"},
          .make = [](const TermSite& at) { return std::make_unique<Motor>(at); }};
}

}  // namespace rvbench::sim
