#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Weight of an arm that turns about a horizontal axis.
///
///     F = A·sin q + B·cos q        A, B = mass times lever times g, by where q = 0 points
///
/// Leaves out: joints below it that tilt the axis.
/// Source: Siciliano et al., Robotics, ch. 7.2
TermType gravity();

}  // namespace rvbench::sim
