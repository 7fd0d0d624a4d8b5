#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double fourth = 0.1;  // order, of the second

// Shafts that are not in line: the jaws of their coupling press and gape twice a turn.
class Jaws final : public BenchEffect {
 public:
  Jaws(double stiffness, double phase_rad) : stiffness_(stiffness), phase_rad_(phase_rad) {}
  double coupling_Nm(const Moment& now) override {
    const double at = 2 * now.q[motor] + phase_rad_;
    return stiffness_ * (now.q[motor] - now.q[sun]) * (std::cos(at) + fourth * std::cos(2 * at));
  }

 private:
  double stiffness_, phase_rad_;
};

}  // namespace

HiddenInBench misalignment(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "misalignment",
          .bodies = {"motor", "input_shaft"},
          .parameter = "stiffness",
          .size = 20,
          .make = [=](double size) { return std::make_unique<Jaws>(size, phase_rad); }};
}

}  // namespace seal
