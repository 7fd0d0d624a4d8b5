#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

// What the flanks deviate by over a pitch: relief at the tips, worn in the middle. Harmonics fall a
// little faster than those of a sawtooth.
TurnTable shape_of(double size_m, double phase_rad) {
  return TurnTable([=](double at) {
    double sum = 0;
    for (int h = 1; h <= 6; ++h) {
      sum += size_m / h * std::exp(-(h - 1) / 8.0) * std::sin(h * (at + phase_rad));
    }
    return sum;
  });
}

class Flanks final : public BenchEffect {
 public:
  Flanks(double size_m, double teeth, double phase_rad)
      : shape_(shape_of(size_m, phase_rad)), teeth_(teeth) {}
  double mesh_error_m(int, double sun_rad, double) override { return shape_(teeth_ * sun_rad); }

 private:
  TurnTable shape_;  // over one pitch
  double teeth_;
};

}  // namespace

HiddenInBench transmission_error(const BenchNumbers& n, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "transmission_error",
          .bodies = {"input_shaft", "planet_1", "planet_2"},
          .without = {"profile_error", "profile_phase"},
          .parameter = "profile_error",
          .size = 1e-6,
          .in_own_lines = true,
          .make = [=](double size_m) {
            return std::make_unique<Flanks>(size_m, n.sun_teeth, phase_rad);
          }};
}

}  // namespace seal
