#include "sim/terms/periodic_push.hpp"

#include <cmath>
#include <utility>

namespace rvbench::sim {

PeriodicPush::PeriodicPush(std::string_view name, Axis axis, double cosine, double sine,
                           double frequency_Hz)
    : OneAxisTerm(name, axis),
      cosine_(cosine),
      sine_(sine),
      frequency_rad_s_(units::two_pi * frequency_Hz) {}

double PeriodicPush::effort(const PlantState& s) const {
  const double phase_rad = frequency_rad_s_ * s.t_s;
  return -cosine_ * std::cos(phase_rad) - sine_ * std::sin(phase_rad);
}

ParameterCard push_card(std::string name) {
  return {.name = std::move(name),
          .unit = UnitKind::force,
          .min = -unbounded,
          .max = unbounded,
          .start = 0.02};
}

}  // namespace rvbench::sim
