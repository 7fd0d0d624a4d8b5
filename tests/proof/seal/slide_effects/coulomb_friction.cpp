#include "tests/proof/seal/bristles.hpp"
#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

class Rubbing final : public SlideEffect {
 public:
  Rubbing(double level_N, double way_m) : level_N_(level_N), bristles_(way_m) {}
  double force_N(double, double speed_m_s, double step_s) override {
    return level_N_ * bristles_.bent_by(speed_m_s, step_s);
  }

 private:
  double level_N_;
  Bristles bristles_;
};

}  // namespace

HiddenInSlide coulomb_friction(const SlideScales& usual, Draw& draw) {
  const double bending_m = usual.way_m * 1e-3 * draw.within_factor(2);
  return {.name = "coulomb_friction",
          .also = {},
          .parameter = "level",
          .size = usual.force_N,
          .make = [=](double size_N) { return std::make_unique<Rubbing>(size_N, bending_m); }};
}

}  // namespace seal
