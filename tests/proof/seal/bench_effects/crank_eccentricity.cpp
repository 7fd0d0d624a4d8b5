#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double throw_m = 1.3e-3;  // of the crank

// A crank whose throw is off by a vector: what its disc travels too far, by Pythagoras.
class Crank final : public BenchEffect {
 public:
  Crank(int stage, double error_m, double circle_m, double phase_rad)
      : stage_(stage), error_m_(error_m), circle_m_(circle_m), phase_rad_(phase_rad) {}
  double stage_error_rad(int stage, double crank_rad) override {
    if (stage != stage_) return 0;
    const double x = throw_m + error_m_ * std::cos(crank_rad + phase_rad_);
    const double y = error_m_ * std::sin(crank_rad + phase_rad_);
    return (std::hypot(x, y) - throw_m) / circle_m_;
  }

 private:
  int stage_;
  double error_m_, circle_m_, phase_rad_;
};

}  // namespace

HiddenInBench crank_eccentricity(const BenchNumbers& n, Draw& draw) {
  const auto stage = static_cast<int>(draw.below(2));
  const double phase_rad = draw.phase_rad();
  return {.name = "crank_eccentricity",
          .bodies = {planet_of(stage), "carrier"},
          .parameter = "crank_error",
          .size = 1e-5,
          .make = [=](double size_m) {
            return std::make_unique<Crank>(stage, size_m, n.pin_circle_m, phase_rad);
          }};
}

}  // namespace seal
