#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A drive whose frequency hunts about the one that it is told: its motor is given more slip, and
/// less, in a rhythm of the drive's own.
///
///     F = −[T(f·(1 + m·cos(2π·f_m·t + φ))) − T(f)]        T of the asynchronous motor
///
/// Leaves out: electrical transients, the voltage that swings too, phase of the inverter's ripple.
/// Source: Lipo & Krause, IEEE Trans. Power App. Syst. 88(1), 55-66 (1969)
TermType speed_modulation();

}  // namespace rvbench::sim
