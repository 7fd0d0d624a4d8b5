#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Viscous friction that falls as its own losses warm the lubricant by θ.
///
///     F = b·exp(−β·θ)·v,   dθ/dt = (R·F·v − θ)/τ
///
/// Only β·R can be told from a torque; β is chosen beforehand.
/// Leaves out: heat from other losses, the temperature of the room.
/// Source: Bittencourt & Axelsson, IEEE/ASME Trans. Mechatronics 19(5), 1669-1678 (2014)
TermType thermal_viscosity();

}  // namespace rvbench::sim
