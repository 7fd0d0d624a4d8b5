#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A resonance that hangs on a body: inertia J·s on a spring, tuned to f.
///
///     J → J·(1 − s);  beyond it J·s on k = (2πf)²·J·s, c = 2ζ·2πf·J·s
///
/// The rigid motion stays as it was.
/// Leaves out: more than one mode, dependence on load.
/// Source: Rao, Mechanical Vibrations, ch. 9.11 (seen from its base)
TermType torsional_mode();

}  // namespace rvbench::sim
