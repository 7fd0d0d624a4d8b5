#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Friction of a lubricant that grows less than in proportion to speed.
///
///     F = T·(v/v_0)·(ε² + (v/v_0)²)^((p − 1)/2)    →  T·|v/v_0|^p well above ε·v_0
///
/// ε = 0.001 keeps the slope at standstill finite.
/// Leaves out: temperature.
/// Source: Bair, High Pressure Rheology for Quantitative Elastohydrodynamics, ch. 6; p = 0.66
/// as tables of gearboxes have it
TermType shear_thinning();

}  // namespace rvbench::sim
