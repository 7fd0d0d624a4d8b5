#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// The parts of a rolling bearing that can be spalled, as plant files count them.
enum class BearingPart { none, outer_race, inner_race, rolling_element };

/// A rolling bearing as what its housing is pushed with: rough surfaces that roll over one another,
/// and the blows of a spalled part.
///
///     F = −√(1 + a₁·cos φ + a₂·cos 2φ)·(w + Σ_i P(t − t_i)),   dφ/dt = 2π·n
///
/// w     random, F_a rms, through one pole at f_c
/// t_i   when the i-th pass of the spall is due, each early or late by chance (σ of an interval):
///       z/2·(1 ∓ d/D·cos β) passes a turn on the outer and inner race, D/d·(1 − (d/D·cos β)²) on
///       a rolling element, which strikes both races in one turn
/// P     half a sine, τ long, of impulse J
/// φ     shaft angle; the load zone swells all of it, at once and twice a turn
///
/// Time      chance is counted from t = 0: a plant gives the same force each time it is run
/// Leaves out: slip, the double blow of entry and exit, the cage, load
/// Source: Antoni & Randall, Mech. Syst. Signal Process. 17(5), 2003, for the spacing by chance;
///         Harris, Rolling Bearing Analysis, ch. 25, for the passes
TermType rolling_bearing();

}  // namespace rvbench::sim
