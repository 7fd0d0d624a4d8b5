#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

class Law final : public SlideEffect {
 public:
  Law(double size, std::function<double(double, double)> law) : size_(size), law_(std::move(law)) {}
  double force_N(double way_m, double speed_m_s, double) override {
    return size_ * law_(way_m, speed_m_s);
  }

 private:
  double size_;
  std::function<double(double, double)> law_;
};

}  // namespace

HiddenInSlide as_law(const HiddenInSlide& effect) {
  return {.name = effect.name,
          .make = [law = effect.law](double size) { return std::make_unique<Law>(size, law); }};
}

}  // namespace seal
