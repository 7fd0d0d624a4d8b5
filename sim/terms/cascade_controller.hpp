#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Position controller of a drive: P on position, PI on speed, after a recorded set-point r.
///
///     e = K_p·(r − q) − v,   dz/dt = e,   F = −clamp(K_v·(e + z/T_i), ±limit)
///
/// z holds still while the output is at its limit and e would drive it further: no wind-up.
/// Leaves out: sampling, the current loop, feed-forward.
/// Source: Åström & Hägglund, Advanced PID Control, ch. 12 (cascade), ch. 3.5 (wind-up)
TermType cascade_controller();

}  // namespace rvbench::sim
