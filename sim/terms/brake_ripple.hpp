#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A load brake whose torque is not the same all round: its disc runs out, or its gap does.
///
///     F = −ρ·u·cos(m·θ + φ)        u: what the brake's input pushes its body with; m per turn
///
/// Leaves out: torque that depends on speed, poles that come more often than twice a turn, and what
/// stays of a hysteresis brake's poles without current.
/// Source: none, assumed: a wave over the angle of 0.5 to 3 % of the torque
TermType brake_ripple();

}  // namespace rvbench::sim
