#include "tests/proof/seal/bristles.hpp"
#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

class Sticking final : public SlideEffect {
 public:
  Sticking(double excess_N, double creep_m_s, double way_m)
      : creep_m_s_(creep_m_s), excess_N_(excess_N), bristles_(way_m) {}
  double force_N(double, double speed_m_s, double step_s) override {
    // What bristles that stick give beyond a level that is known; it is gone far above creep.
    const double way = speed_m_s / creep_m_s_;
    const double level_N = excess_N_ / (1 + way * way);
    return level_N * bristles_.bent_by(speed_m_s, step_s);
  }

 private:
  double creep_m_s_, excess_N_;
  Bristles bristles_;
};

}  // namespace

HiddenInSlide stribeck_friction(const SlideScales& usual, Draw& draw) {
  const double creep_m_s = usual.speed_m_s * draw.uniform(0.05, 0.2);
  const double bending_m = usual.way_m * 1e-3 * draw.within_factor(2);
  return {
      .name = "stribeck_friction", .also = {}, .size = usual.force_N, .make = [=](double size_N) {
        return std::make_unique<Sticking>(size_N, creep_m_s, bending_m);
      }};
}

}  // namespace seal
