#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A broken or unequal bar of an asynchronous motor's rotor: what the motor gives swells and fades
/// as the field runs past that bar, once for each of its poles.
///
///     F = −ρ·T·cos(2ψ + φ),  dψ/dt = 2π·f − p·ω        T of the motor, ψ the slip angle
///
/// Leaves out: the loss of mean torque, 4·s·f and above, what speed ripple at 2·s·f gives back.
/// Source: Thomson & Fenger, IEEE Ind. Appl. Mag. 7(4), 26-31 (2001): sidebands at 2·s·f
TermType rotor_bar();

}  // namespace rvbench::sim
