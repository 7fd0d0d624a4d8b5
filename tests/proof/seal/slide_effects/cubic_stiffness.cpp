#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr double long_over_way = 3;

// A string across the way: it is stretched by the square root of what the way adds. Its linear part
// is none, so that the slide's own spring stays what it is.
class String final : public SlideEffect {
 public:
  String(double stiffness, double way_m)
      : stiffness_(stiffness), length_m_(long_over_way * way_m) {}
  double force_N(double way_m, double, double) override {
    const double length_m = std::hypot(way_m, length_m_);
    return 2 * stiffness_ * length_m_ * length_m_ * way_m * (1 - length_m_ / length_m);
  }

 private:
  double stiffness_, length_m_;
};

}  // namespace

HiddenInSlide cubic_stiffness(const SlideScales& usual, Draw& draw) {
  (void)draw;
  const double way_m = usual.way_m;
  return {.name = "cubic_stiffness",
          .also = {},
          .parameter = "stiffness",
          .size = usual.force_N / (way_m * way_m * way_m),
          .make = [=](double size) { return std::make_unique<String>(size, way_m); },
          .law = [](double x_m, double) { return x_m * x_m * x_m; }};
}

}  // namespace seal
