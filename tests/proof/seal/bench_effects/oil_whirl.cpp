#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double order = 0.43;  // of the shaft: a film of oil that goes round with it

// A whirl that is no part of any gear. rvbench has no term for it.
class Whirl final : public BenchEffect {
 public:
  Whirl(double size_Nm, double phase_rad) : size_Nm_(size_Nm), phase_rad_(phase_rad) {}
  void push(const Moment& now, double, Eigen::VectorXd& torque_Nm) override {
    torque_Nm[sun] += size_Nm_ * std::cos(order * now.q[sun] + phase_rad_);
  }

 private:
  double size_Nm_, phase_rad_;
};

}  // namespace

HiddenInBench oil_whirl(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "oil_whirl",
          .bodies = {"input_shaft"},
          .anywhere = true,
          .size = 0.01,
          .line_Hz = [](double, double shaft_Hz) { return order * shaft_Hz; },
          .make = [=](double size_Nm) { return std::make_unique<Whirl>(size_Nm, phase_rad); }};
}

}  // namespace seal
