#include <algorithm>

#include "tests/proof/seal/bristles.hpp"
#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

class OneWay final : public SlideEffect {
 public:
  OneWay(double level_N, double way_m) : level_N_(level_N), bristles_(way_m) {}
  double force_N(double, double speed_m_s, double step_s) override {
    return level_N_ * std::max(bristles_.bent_by(speed_m_s, step_s), 0.0);
  }

 private:
  double level_N_;
  Bristles bristles_;
};

}  // namespace

HiddenInSlide asymmetric_friction(const SlideScales& usual, Draw& draw) {
  const double bending_m = usual.way_m * 1e-3 * draw.within_factor(2);
  return {.name = "asymmetric_friction",
          .also = {},
          .parameter = "level",
          .size = usual.force_N,
          .make = [=](double size_N) { return std::make_unique<OneWay>(size_N, bending_m); }};
}

}  // namespace seal
