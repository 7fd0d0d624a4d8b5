#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A vibration sensor that does not sit firmly: one channel shows the end of a spring and a damper
/// in place of the body that it is fixed to.
///
///     m·a = −k·(q − q_body) − c·(v − v_body),   k = (2πf)²·m,  c = 2ζ·2πf·m
///     shown/moved = (1 + 2jζr)/(1 − r² + 2jζr),  r = frequency/f
///
/// m is 1e-6 of the body's mass, to be integrated: where f meets a resonance of the body, it
/// changes that by 1e-6/(4·ζ·ζ_body), which a ζ of 0.005 at least keeps small.
///
/// Leaves out: what the sensor's mass does to the body, tilt, more than one mode.
/// Source: ISO 5348 (2021), mounting of accelerometers; Rao, Mechanical Vibrations, ch. 3.6
TermType sensor_mount();

}  // namespace rvbench::sim
