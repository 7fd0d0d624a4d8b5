#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Damping that grows with the square of the way.
///
///     F = c·(x/x_0)²·v
///
/// Leaves out: damping that grows with speed (nonlinear_damping).
/// Source: Nayfeh & Mook, Nonlinear Oscillations, ch. 3.3 (van der Pol's, of one sign)
TermType displacement_damping();

}  // namespace rvbench::sim
