#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Spring and damper side by side, as one term: F = k·x + c·v, x = q_a − q_b. Its effort is what a
/// torque transducer on the shaft shows.
///
/// Leaves out: backlash, hysteresis of a rubber coupling, its mass.
/// Source: Rao, Mechanical Vibrations, ch. 1 (Kelvin-Voigt element)
TermType shaft_torsion();

}  // namespace rvbench::sim
