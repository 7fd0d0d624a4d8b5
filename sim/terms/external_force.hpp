#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A force from outside that keeps its own time: mains, a fan, a neighbouring machine.
///
///     F = −A·cos(2πft + φ)        pushes forward where the cosine is 1
///
/// Leaves out: harmonics (one term each), drift of the frequency.
/// Source: Rao, Mechanical Vibrations, ch. 3
TermType external_force();

}  // namespace rvbench::sim
