#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double second = 0.1;  // harmonic

// A rotor that runs out in its gap.
class Poles final : public BenchEffect {
 public:
  Poles(double depth, double phase_rad) : depth_(depth), phase_rad_(phase_rad) {}
  void push(const Moment& now, double, Eigen::VectorXd& torque_Nm) override {
    const double at = now.q[brake] + phase_rad_;
    torque_Nm[brake] -= depth_ * now.brake_Nm * (std::cos(at) + second * std::cos(2 * at));
  }

 private:
  double depth_, phase_rad_;
};

}  // namespace

HiddenInBench brake_ripple(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "brake_ripple",
          .bodies = {"brake"},
          .parameter = "depth",
          .size = 0.01,
          .make = [=](double depth) { return std::make_unique<Poles>(depth, phase_rad); }};
}

}  // namespace seal
