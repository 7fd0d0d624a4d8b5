#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr double power = 0.35;  // of the shear rate, by which the viscosity falls

// Grease whose viscosity falls once it is sheared faster than a rate.
// Source  Yasuda, Armstrong & Cohen, Rheol. Acta 20, 163-178 (1981), eq. 1
class Grease final : public SlideEffect {
 public:
  Grease(double damping, double knee_m_s) : damping_(damping), knee_m_s_(knee_m_s) {}
  double force_N(double, double speed_m_s, double) override {
    const double rate = speed_m_s / knee_m_s_;
    return damping_ * speed_m_s * std::pow(1 + rate * rate, -power / 2);
  }

 private:
  double damping_, knee_m_s_;
};

}  // namespace

HiddenInSlide shear_thinning(const SlideScales& usual, Draw& draw) {
  const double knee_m_s = usual.speed_m_s * draw.uniform(0.02, 0.05);
  return {.name = "shear_thinning",
          .also = {},
          .size = usual.force_N / usual.speed_m_s,
          .make = [=](double size) { return std::make_unique<Grease>(size, knee_m_s); }};
}

}  // namespace seal
