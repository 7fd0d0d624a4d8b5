#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {
namespace {

constexpr double bend_over_way = 6;

// An arch that gives way on one side and holds on the other.
class Arch final : public SlideEffect {
 public:
  Arch(double stiffness, double way_m) : stiffness_(stiffness), reach_m_(bend_over_way * way_m) {}
  double force_N(double way_m, double, double) override {
    const double bent = way_m / reach_m_;
    return stiffness_ * way_m * way_m / (1 + bent * bent);
  }

 private:
  double stiffness_, reach_m_;
};

}  // namespace

HiddenInSlide quadratic_stiffness(const SlideScales& usual, Draw& draw) {
  const double side = draw.sign(), way_m = usual.way_m;
  return {.name = "quadratic_stiffness",
          .also = {},
          .parameter = "stiffness",
          .size = side * usual.force_N / (way_m * way_m),
          .make = [=](double size) { return std::make_unique<Arch>(size, way_m); },
          .law = [](double x_m, double) { return x_m * x_m; }};
}

}  // namespace seal
