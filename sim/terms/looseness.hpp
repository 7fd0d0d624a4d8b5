#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Stiffness that is different beyond a threshold: a stop, or a joint that opens.
///
///     F = Δk·max(x − x_0, 0)
///
/// Leaves out: rubbing, loss at impact.
/// Source: Muszynska & Goldman, Chaos, Solitons & Fractals 5(9), 1683-1704 (1995)
TermType looseness();

}  // namespace rvbench::sim
