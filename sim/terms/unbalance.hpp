#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Pull of an unbalanced rotor on what carries it.
///
///     F = −U·ω²·cos(θ + φ)        θ, ω of the rotor; U = mass times eccentricity
///
/// Leaves out: the rotor's own reaction, its angular acceleration.
/// Source: Rao, Mechanical Vibrations, ch. 3.7
TermType unbalance();

}  // namespace rvbench::sim
