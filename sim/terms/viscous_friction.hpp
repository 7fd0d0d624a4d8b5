#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Friction in proportion to speed.
///
///     F = b·v
///
/// Leaves out: shear thinning, temperature.
/// Source: Armstrong-Hélouvry, Dupont & Canudas de Wit, Automatica 30(7), 1083-1138 (1994), §2
TermType viscous_friction();

}  // namespace rvbench::sim
