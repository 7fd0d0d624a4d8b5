#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr int poles = 24;

// A brake whose poles pull its rotor to one side after another. rvbench has no term for it.
class Cogging final : public BenchEffect {
 public:
  Cogging(double size_Nm, double phase_rad) : size_Nm_(size_Nm), phase_rad_(phase_rad) {}
  void push(const Moment& now, double, Eigen::VectorXd& torque_Nm) override {
    torque_Nm[brake] += size_Nm_ * std::cos(poles * now.q[brake] + phase_rad_);
  }

 private:
  double size_Nm_, phase_rad_;
};

}  // namespace

HiddenInBench magnetic_poles(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "magnetic_poles", .bodies = {"brake"}, .size = 1, .make = [=](double size_Nm) {
            return std::make_unique<Cogging>(size_Nm, phase_rad);
          }};
}

}  // namespace seal
