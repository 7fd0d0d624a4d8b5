#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A drive that is not rigid: part of the inertia sits behind a spring.
///
///     J → J·(1 − s) with all that drove it;  beyond it J·s, on k·(q − q_far) + c·(v − v_far)
///
/// The rigid motion stays as it was. EffectSite::beyond names the terms that go to the far side.
/// Leaves out: more than one mode.
/// Source: Spong, J. Dyn. Syst. Meas. Control 109(4), 310-318 (1987)
TermType series_compliance();

}  // namespace rvbench::sim
