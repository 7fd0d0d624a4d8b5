#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double twelfth = 0.15;  // harmonic of the field, of the sixth

// Fifth and seventh harmonics of the inverter's current.
class Currents final : public BenchEffect {
 public:
  explicit Currents(double depth) : depth_(depth) {}
  void push(const Moment& now, double, Eigen::VectorXd& torque_Nm) override {
    const double at = 6 * now.electrical_rad;
    torque_Nm[motor] += depth_ * now.motor_Nm * (std::cos(at) + twelfth * std::cos(2 * at));
  }

 private:
  double depth_;
};

}  // namespace

HiddenInBench inverter_ripple(const BenchNumbers&, Draw&) {
  return {.name = "inverter_ripple",
          .bodies = {"motor"},
          .without = {"ripple"},
          .parameter = "ripple",
          .size = 0.01,
          .line_Hz = [](double supply_Hz, double) { return 6 * supply_Hz; },
          .make = [=](double depth) { return std::make_unique<Currents>(depth); }};
}

}  // namespace seal
