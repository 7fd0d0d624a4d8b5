#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

// A planet that turns about another point than its centre; its pressure angle sways with it.
class Planet final : public BenchEffect {
 public:
  Planet(int mesh, double error_m, double radius_m, double phase_rad)
      : mesh_(mesh), error_m_(error_m), radius_m_(radius_m), phase_rad_(phase_rad) {}
  double mesh_error_m(int mesh, double, double planet_rad) override {
    if (mesh != mesh_) return 0;
    const double at = planet_rad + phase_rad_;
    return error_m_ * std::cos(at) * (1 + error_m_ / radius_m_ * std::sin(at));
  }

 private:
  int mesh_;
  double error_m_, radius_m_, phase_rad_;
};

}  // namespace

HiddenInBench gear_eccentricity(const BenchNumbers& n, Draw& draw) {
  const auto mesh = static_cast<int>(draw.below(2));
  const double phase_rad = draw.phase_rad();
  return {.name = "gear_eccentricity",
          .bodies = {"input_shaft", planet_of(mesh)},
          .parameter = "planet_eccentricity",
          .size = 1e-5,
          .make = [=](double size_m) {
            return std::make_unique<Planet>(mesh, size_m, n.planet_radius_m, phase_rad);
          }};
}

}  // namespace seal
