#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double second = 0.1;  // harmonic: lobes are rounder than pins

// The ring of pins, which all discs roll off: each pin that a lobe passes pushes the disc.
class Lobes final : public BenchEffect {
 public:
  Lobes(double size_rad, double pins, double phase_rad)
      : size_rad_(size_rad), pins_(pins), phase_rad_(phase_rad) {}
  double stage_error_rad(int, double crank_rad) override {
    const double at = pins_ * crank_rad + phase_rad_;
    return size_rad_ * (std::cos(at) + second * std::cos(2 * at));
  }

 private:
  double size_rad_, pins_, phase_rad_;
};

}  // namespace

HiddenInBench pin_ripple(const BenchNumbers& n, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "pin_ripple",
          .bodies = {"planet_1", "planet_2", "carrier"},
          .parameter = "pin_error",
          .size = 1e-6,
          .make = [=](double size_m) {
            return std::make_unique<Lobes>(size_m / n.pin_circle_m, n.pins, phase_rad);
          }};
}

}  // namespace seal
