#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A drive that gives no more than its limit: takes away what an input asks for beyond it.
///
///     F = u − clamp(u, ±L)        u is the recorded force that pushes the same body
///
/// Leaves out: a limit that falls with speed, recovery time.
/// Source: Tarbouriech et al., Stability and Stabilization of Linear Systems with Saturating
/// Actuators, ch. 1
TermType saturation();

}  // namespace rvbench::sim
