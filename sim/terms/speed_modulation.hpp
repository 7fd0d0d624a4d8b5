#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A drive whose frequency hunts about the one that it is told: its motor is given more slip, and
/// less, in a rhythm of the drive's own.
///
///     F = −[T(f·(1 + m·cos(2π·f_m·t + φ))) − T(f)]        T of the asynchronous motor
///
/// On average it adds T''·δ²/4, δ being the swing of the slip and T'' the curvature of T over it.
///
/// Leaves out: electrical transients, the voltage that swings too, phase of the inverter's ripple.
/// Compared by orders it is tried at the mains' frequencies only, whatever the drive hunts at.
/// Source: Lipo & Krause, IEEE Trans. Power App. Syst. 88(1), 55-66 (1969)
TermType speed_modulation();

}  // namespace rvbench::sim
