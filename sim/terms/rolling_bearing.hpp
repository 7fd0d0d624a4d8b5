#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// The parts of a rolling bearing that can be spalled, as plant files count them.
enum class BearingPart { none, outer_race, inner_race, rolling_element };

/// A rolling bearing as what its housing is pushed with: rough surfaces that roll over one another,
/// and the blows of a spalled part.
///
///     F = −√(1 + a₁·cos φ + a₂·cos 2φ)·w − √(1 + a₁·cos νφ + a₂·cos 2νφ)·Σ_i P(t − t_i)
///     dφ/dt = 2π·n
///
/// w     random, F_a rms, through one pole at f_c
/// t_i   when the i-th pass of the spall is due, each early or late by chance (σ of an interval):
///       z/2·(1 ∓ d/D·cos β) passes a turn on the outer and inner race, D/d·(1 − (d/D·cos β)²) on
///       a rolling element, which strikes both races in one turn
/// P     half a sine, τ long, of impulse J
/// φ     shaft angle; the load zone swells the rolling once and twice a turn,
/// νφ    and the blows as their part goes through it: with the shaft on the inner race, with the
///       cage on a rolling element, never on the outer race
///
/// Time      a plant gives the same force each time it is run; `seed` gives another
/// Leaves out: slip, the double blow of entry and exit, load
/// Source: Antoni & Randall, J. Vib. Acoust. 125(3), 282-289 (2003), for the spacing by chance;
///         Harris, Rolling Bearing Analysis, ch. 25, for the passes;
///         McFadden & Smith, J. Sound Vib. 96(1), 69-82 (1984), for the load zone
TermType rolling_bearing();

}  // namespace rvbench::sim
