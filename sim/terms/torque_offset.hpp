#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A constant that the body has to give: an offset of the sensor or amplifier, a weight.
///
///     F = T_0
///
/// Leaves out: drift.
/// Source: Gautier & Poignet, Control Eng. Practice 9, 139-148 (2001): part of every base model
TermType torque_offset();

}  // namespace rvbench::sim
