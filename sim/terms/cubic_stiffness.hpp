#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Spring that hardens (or softens) alike on both sides: Duffing.
///
///     F = k_3·x³
///
/// Leaves out: even powers (quadratic_stiffness).
/// Source: Kovacic & Brennan, The Duffing Equation, ch. 1
TermType cubic_stiffness();

}  // namespace rvbench::sim
