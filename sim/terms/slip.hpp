#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A drive that keeps its speed whatever is asked of it: a synchronous machine, or an asynchronous
/// one whose slip nobody has thought of.
///
///     F = T_r/s_0·(v/ω_s − 1)        s_0 = 10⁻⁶: no measurement sees it
///
/// Leaves out: the swing of the load angle, pull-out.
/// Source: Fitzgerald, Electric Machinery, ch. 5
TermType synchronous_drive();

/// Slip of an asynchronous motor, in place of a drive at synchronous speed: it slows down in
/// proportion to its torque.
///
///     s = 1 − v/ω_s = s_r·T/T_r,  so  F = T_r/s_r·(v/ω_s − 1)
///
/// The straight part of Kloss' curve T = 2·T_k/(s/s_k + s_k/s), with T_r/s_r = 2·T_k/s_k.
/// Leaves out: the curve's bend towards pull-out, the voltage (slip grows as its inverse square),
/// the rotor's heating (0.4 % of the slip per kelvin of copper).
/// Source: Fitzgerald, Electric Machinery, ch. 6
TermType slip();

}  // namespace rvbench::sim
