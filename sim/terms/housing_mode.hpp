#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A frame that gives way: what joins a body to the housing ends in a modal mass, which a spring
/// and a damper hold on the ground.
///
///     M·a = F − k·q − c·v,   M = ratio·m,  k = (2πf)²·M,  c = 2ζ·2πf·M
///
/// m is the body's mass, F what its terms against the housing push back with, f the resonance of
/// the frame without the body.
///
/// Leaves out: more than one mode; inputs and sensors stay with the ground.
/// Source: Ewins, Modal Testing, ch. 2.3 (2000)
TermType housing_mode();

}  // namespace rvbench::sim
