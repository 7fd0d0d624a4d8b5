#include <algorithm>
#include <array>

#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr int elements = 12;

// Springs in parallel that slip one after the other.
// Source  Iwan, J. Appl. Mech. 33(4), 893-900 (1966)
class Slipping final : public SlideEffect {
 public:
  Slipping(double stiffness, double yield_m) : stiffness_(stiffness), yield_m_(yield_m) {}
  double force_N(double way_m, double, double) override {
    double sum_N = 0;
    for (int i = 0; i < elements; ++i) {
      const double most_m = yield_m_ * (i + 1.0) / elements * 2;
      double& slipped_m = slipped_m_[static_cast<std::size_t>(i)];
      slipped_m = std::clamp(slipped_m, way_m - most_m, way_m + most_m);
      sum_N += stiffness_ / elements * (way_m - slipped_m);
    }
    return sum_N;
  }

 private:
  double stiffness_, yield_m_;
  std::array<double, elements> slipped_m_{};
};

}  // namespace

HiddenInSlide stiffness_hysteresis(const SlideScales& usual, Draw& draw) {
  const double yield_m = usual.way_m * draw.uniform(0.1, 0.3);
  return {.name = "stiffness_hysteresis",
          .also = {"coulomb_friction"},
          .size = usual.force_N / yield_m,
          .make = [=](double size) { return std::make_unique<Slipping>(size, yield_m); }};
}

}  // namespace seal
