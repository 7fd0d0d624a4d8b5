#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// What friction is higher at creep than when it slides: beside coulomb_friction.
///
///     F = ΔT·exp(−|v/v_s|^δ)·tanh(v/v_ε)
///
/// Leaves out: presliding, the delay of the film (LuGre).
/// Source: Armstrong-Hélouvry, Dupont & Canudas de Wit, Automatica 30(7), 1083-1138 (1994), §2.1
TermType stribeck_friction();

}  // namespace rvbench::sim
