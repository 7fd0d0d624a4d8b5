#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Damping that grows with the square of speed.
///
///     F = c_2·|v|·v
///
/// Leaves out: damping that grows with the way (displacement_damping).
/// Source: Nayfeh & Mook, Nonlinear Oscillations, ch. 3.3
TermType nonlinear_damping();

}  // namespace rvbench::sim
