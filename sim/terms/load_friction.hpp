#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Friction in proportion to what another term passes.
///
///     F = μ·|F_load|·tanh(v/v_ε)
///
/// Leaves out: efficiency that differs between driving and being driven.
/// Source: Bittencourt & Gunnarsson, J. Dyn. Syst. Meas. Control 134(5), 051013 (2012)
TermType load_friction();

}  // namespace rvbench::sim
