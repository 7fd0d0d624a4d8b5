#include "sim/terms/dry_friction.hpp"

#include <stdexcept>
#include <string>

namespace rvbench::sim {

DryFriction::DryFriction(std::string_view name, Axis axis, double creep_speed)
    : OneAxisTerm(name, axis), creep_speed_(creep_speed) {
  if (!(creep_speed > 0)) {
    throw std::invalid_argument(std::string(name) + ": creep_speed must be > 0");
  }
}

ParameterCard creep_speed_card() {
  return {.name = "creep_speed",
          .unit = UnitKind::speed,
          .min = smallest,
          .max = unbounded,
          .start = 0.01,
          .fitted = false};
}

}  // namespace rvbench::sim
