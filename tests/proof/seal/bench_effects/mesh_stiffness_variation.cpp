#include <algorithm>

#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double single = 0.4;  // of a pitch with one pair in contact
constexpr double ramp = 0.15;   // of a pitch in which a pair takes over its load
constexpr double first_harmonic = 0.58;

// How much softer the mesh is with one pair of teeth in contact than with two, over a pitch.
TurnTable shape_of(double size, double phase_rad) {
  return TurnTable([=](double at) {
    const double away = std::abs(std::remainder(at + phase_rad, turn)) / turn;  // 0 to 1/2
    const double inside = std::clamp((single / 2 + ramp / 2 - away) / ramp, 0.0, 1.0);
    return size / first_harmonic * (inside - single);
  });
}

class Pairs final : public BenchEffect {
 public:
  Pairs(double size, double teeth, double phase_rad)
      : shape_(shape_of(size, phase_rad)), teeth_(teeth) {}
  double mesh_softening(int, double sun_rad) override { return shape_(teeth_ * sun_rad); }

 private:
  TurnTable shape_;  // over one pitch
  double teeth_;
};

}  // namespace

HiddenInBench mesh_stiffness_variation(const BenchNumbers& n, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {
      .name = "mesh_stiffness_variation",
      .bodies = {"input_shaft", "planet_1", "planet_2"},
      .without = {"stiffness_ripple", "stiffness_ripple_phase"},
      .parameter = "stiffness_ripple",
      .size = 0.05,
      .most = 0.4,
      .in_own_lines = true,
      .make = [=](double size) { return std::make_unique<Pairs>(size, n.sun_teeth, phase_rad); }};
}

}  // namespace seal
