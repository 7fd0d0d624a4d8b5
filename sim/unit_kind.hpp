#pragma once

#include <string_view>

namespace rvbench::sim {

enum class Motion { rotation, translation };

/// What a number of a plant is. Its unit follows from the motion of the body that it acts on.
enum class UnitKind {
  ratio,
  inertia,
  force,
  stiffness,
  quadratic_stiffness,
  cubic_stiffness,
  damping,
  quadratic_damping,
  coordinate,
  speed,
  acceleration,
  frequency,
  time,
  angle,
  temperature,
  per_temperature,
  thermal_resistance,
  mass_offset,
  motor_constant,
  resistance,
  impulse,
  length,             ///< of a gear, whatever its body does
  contact_stiffness,  ///< of teeth along their line of action
  contact_damping,
  channel  ///< of what one channel shows, in that channel's unit: see unit_at()
};

/// "N·m/rad", "N/m", ... ; "1" for a plain ratio.
std::string_view unit_of(UnitKind kind, Motion motion);

/// How large things are on one plant: what a record shows before anything was fitted.
struct NaturalScales {
  double force = 1;       ///< N or N·m
  double coordinate = 1;  ///< m or rad
  double speed = 1;       ///< m/s or rad/s
};

/// The size of a parameter that matters on such a plant; 1 where the scales do not say.
double natural_scale(UnitKind kind, const NaturalScales& scales);

}  // namespace rvbench::sim
