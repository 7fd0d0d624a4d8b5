#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Spring that is stiffer on one side than on the other.
///
///     F = k_2·x²
///
/// Leaves out: odd powers (cubic_stiffness).
/// Source: Kovacic & Brennan, The Duffing Equation, ch. 7
TermType quadratic_stiffness();

}  // namespace rvbench::sim
