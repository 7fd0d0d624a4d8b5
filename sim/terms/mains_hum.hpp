#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// What the mains induce in one channel's wire, and no force.
///
///     channel += A·cos(2πft + φ)      f one of 50, 60, 100, 120 Hz: the mains, or twice the mains
///
/// t is what the recording gives as time: parts of one recording hum in step.
///
/// Leaves out: drift of the mains' frequency, another phase in each record, higher harmonics.
/// Source: Ott, Electromagnetic Compatibility Engineering, ch. 2 (2009)
TermType mains_hum();

}  // namespace rvbench::sim
