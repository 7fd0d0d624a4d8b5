#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A coupling that is softer one way than across: its torque goes up and down twice per
/// turn, or four times.
TermType misalignment();

}  // namespace rvbench::sim
