#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// A screw that runs heavier once in each of its turns. rvbench has no term for it.
class Screw final : public SlideEffect {
 public:
  Screw(double size_N, double lead_m, double phase_rad)
      : size_N_(size_N), lead_m_(lead_m), phase_rad_(phase_rad) {}
  double force_N(double way_m, double, double) override {
    return size_N_ * std::cos(turn * way_m / lead_m_ + phase_rad_);
  }

 private:
  double size_N_, lead_m_, phase_rad_;
};

}  // namespace

HiddenInSlide screw_ripple(const SlideScales& usual, Draw& draw) {
  const double lead_m = draw.uniform(0.02, 0.04), phase_rad = draw.phase_rad();
  return {.name = "screw_ripple", .size = usual.force_N, .make = [=](double size_N) {
            return std::make_unique<Screw>(size_N, lead_m, phase_rad);
          }};
}

}  // namespace seal
