#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Linear spring: F = k·x, x = q_a − q_b. What plants are built of.
///
/// Leaves out: its mass, its damping (a damper beside it).
/// Source: Rao, Mechanical Vibrations, ch. 1
TermType spring();

}  // namespace rvbench::sim
