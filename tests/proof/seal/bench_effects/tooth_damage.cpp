#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double pitches_per_width = 14;  // a third of a pitch at its foot

// A flank that has lost some of its height, rounded by what rolls over it.
class Dent final : public BenchEffect {
 public:
  Dent(int mesh, double depth_m, double width_rad, double place_rad)
      : mesh_(mesh), depth_m_(depth_m), width_rad_(width_rad), place_rad_(place_rad) {}
  double mesh_error_m(int mesh, double, double planet_rad) override {
    if (mesh != mesh_) return 0;
    const double away = std::remainder(planet_rad - place_rad_, turn) / width_rad_;
    return std::abs(away) > 6 ? 0 : -depth_m_ * std::exp(-away * away / 2);
  }

 private:
  int mesh_;
  double depth_m_, width_rad_, place_rad_;
};

}  // namespace

HiddenInBench tooth_damage(const BenchNumbers& n, Draw& draw) {
  const auto mesh = static_cast<int>(draw.below(2));
  const double place_rad = draw.phase_rad();
  const double pitch_rad = turn / (n.sun_teeth * n.planet_radius_m / n.sun_radius_m);
  return {.name = "tooth_damage",
          .also = {"gear_eccentricity"},
          .bodies = {"input_shaft", planet_of(mesh)},
          .size = 1e-5,
          .make = [=](double size_m) {
            return std::make_unique<Dent>(mesh, size_m, pitch_rad / pitches_per_width, place_rad);
          }};
}

}  // namespace seal
