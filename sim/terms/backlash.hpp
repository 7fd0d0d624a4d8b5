#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A spring with play: nothing is passed within the gap.
///
///     F = k·(x − clamp(x, −g/2, +g/2)),   x = q_a − q_b
///
/// As an effect it takes the place of a spring (EffectSite::reference) and keeps its stiffness.
/// Leaves out: loss at impact, oil in the gap.
/// Source: Nordin & Gutman, Automatica 38(10), 1633-1649 (2002), §2.1
TermType backlash();

}  // namespace rvbench::sim
