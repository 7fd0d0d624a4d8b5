#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Dry friction, the same at all speeds and loads.
///
///     F = T_c·tanh(v/v_ε)
///
/// Leaves out: stiction, dependence on speed, load and temperature. Below v_ε it creeps.
/// Source: Armstrong-Hélouvry, Dupont & Canudas de Wit, Automatica 30(7), 1083-1138 (1994), §2
TermType coulomb_friction();

}  // namespace rvbench::sim
