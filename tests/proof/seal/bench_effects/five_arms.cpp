#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr int arms = 5;

// A coupling whose arms are bent unevenly: five pushes a turn. rvbench has no term for it.
class Arms final : public BenchEffect {
 public:
  Arms(double stiffness, double phase_rad) : stiffness_(stiffness), phase_rad_(phase_rad) {}
  double coupling_Nm(const Moment& now) override {
    return stiffness_ * std::cos(arms * now.q[motor] + phase_rad_);
  }

 private:
  double stiffness_, phase_rad_;
};

}  // namespace

HiddenInBench five_arms(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "five_arms",
          .bodies = {"motor", "input_shaft"},
          .anywhere = true,
          .size = 0.01,
          .make = [=](double size) { return std::make_unique<Arms>(size, phase_rad); }};
}

}  // namespace seal
