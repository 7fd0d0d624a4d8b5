#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

class Oil final : public SlideEffect {
 public:
  explicit Oil(double damping) : damping_(damping) {}
  double force_N(double, double speed_m_s, double) override { return damping_ * speed_m_s; }

 private:
  double damping_;
};

}  // namespace

HiddenInSlide viscous_friction(const SlideScales& usual, Draw& draw) {
  (void)draw;
  return {.name = "viscous_friction",
          .parameter = "damping",
          .size = usual.force_N / usual.speed_m_s,
          .make = [](double size) { return std::make_unique<Oil>(size); }};
}

}  // namespace seal
