#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// More friction in one direction than in the other.
///
///     F = (|c| + |b|·|v|)·tanh(v/v_ε)      c acts where v has the sign of c, b where it has its
///
/// Leaves out: what the two directions share (coulomb_friction, viscous_friction).
/// Source: Armstrong-Hélouvry, Dupont & Canudas de Wit, Automatica 30(7), 1083-1138 (1994), §2.1
TermType asymmetric_friction();

}  // namespace rvbench::sim
