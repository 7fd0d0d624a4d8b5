#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr double roundness = 0.03;  // of the usual way, over which the contact comes to bear

class Stop final : public SlideEffect {
 public:
  Stop(double stiffness, double place_m, double way_m)
      : stiffness_(stiffness), place_m_(place_m), round_m_(roundness * way_m) {}
  double force_N(double way_m, double, double) override {
    const double pressed_m = way_m - place_m_;
    return stiffness_ * (pressed_m + std::hypot(pressed_m, round_m_)) / 2;
  }

 private:
  double stiffness_, place_m_, round_m_;
};

}  // namespace

HiddenInSlide looseness(const SlideScales& usual, Draw& draw) {
  const double way_m = usual.way_m, place_m = way_m * draw.uniform(0.5, 1.2);
  return {.name = "looseness",
          .also = {},
          .parameter = "stiffness_change",
          .size = usual.force_N / way_m,
          .make = [=](double size) { return std::make_unique<Stop>(size, place_m, way_m); }};
}

}  // namespace seal
