#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// A spring whose stiffness somebody changes in time. rvbench has no term for it.
class Pumped final : public SlideEffect {
 public:
  Pumped(double stiffness, double frequency_Hz)
      : stiffness_(stiffness), rate_(turn * frequency_Hz) {}
  double force_N(double way_m, double, double step_s) override {
    time_s_ += step_s;
    return stiffness_ * std::cos(rate_ * time_s_) * way_m;
  }

 private:
  double stiffness_, rate_, time_s_ = 0;
};

}  // namespace

HiddenInSlide pumped_spring(const SlideScales& usual, Draw& draw) {
  const double frequency_Hz = draw.uniform(0.7, 1.6);
  return {.name = "pumped_spring", .size = usual.force_N / usual.way_m, .make = [=](double size) {
            return std::make_unique<Pumped>(size, frequency_Hz);
          }};
}

}  // namespace seal
