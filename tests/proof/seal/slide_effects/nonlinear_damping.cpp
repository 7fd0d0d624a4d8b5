#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr double transition = 0.05;  // of the usual speed, where drag comes to be turbulent

class Drag final : public SlideEffect {
 public:
  Drag(double size, double speed_m_s) : size_(size), slow_m_s_(transition * speed_m_s) {}
  double force_N(double, double speed_m_s, double) override {
    return size_ * speed_m_s * std::hypot(speed_m_s, slow_m_s_);
  }

 private:
  double size_, slow_m_s_;
};

}  // namespace

HiddenInSlide nonlinear_damping(const SlideScales& usual, Draw& draw) {
  (void)draw;
  const double speed_m_s = usual.speed_m_s;
  return {.name = "nonlinear_damping",
          .also = {"displacement_damping"},
          .parameter = "damping",
          .size = usual.force_N / (speed_m_s * speed_m_s),
          .make = [=](double size) { return std::make_unique<Drag>(size, speed_m_s); },
          .law = [](double, double v_m_s) { return v_m_s * std::abs(v_m_s); }};
}

}  // namespace seal
