#include "tests/proof/seal/bristles.hpp"
#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

class Rubbing final : public SlideEffect {
 public:
  Rubbing(double level_N, double way_m) : bristles_({level_N, level_N, 1, level_N / way_m}) {}
  double force_N(double, double speed_m_s, double step_s) override {
    return bristles_.force_N(speed_m_s, step_s);
  }

 private:
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
