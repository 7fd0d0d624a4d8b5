#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double twice = 0.1;  // at four times the slip's frequency

// A broken bar passes the field's poles with the slip.
class Bar final : public BenchEffect {
 public:
  Bar(double depth, double phase_rad) : depth_(depth), phase_rad_(phase_rad) {}
  void push(const Moment& now, double step_s, Eigen::VectorXd& torque_Nm) override {
    phase_rad_ = std::fmod(phase_rad_ + 2 * now.slip_rad_s * step_s, turn);
    const double wave = std::cos(phase_rad_) + twice * std::cos(2 * phase_rad_);
    torque_Nm[motor] += depth_ * now.motor_Nm * wave;
  }

 private:
  double depth_, phase_rad_;
};

}  // namespace

HiddenInBench rotor_bar(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {
      .name = "rotor_bar",
      .bodies = {"motor"},
      .parameter = "depth",
      .size = 0.01,
      .line_Hz = [](double supply_Hz, double shaft_Hz) { return 2 * (supply_Hz - 2 * shaft_Hz); },
      .make = [=](double depth) { return std::make_unique<Bar>(depth, phase_rad); }};
}

}  // namespace seal
