#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Linear damper: F = c·v, v = v_a − v_b. What plants are built of; against the housing it is the
/// same as viscous_friction.
///
/// Leaves out: dependence on temperature and load.
/// Source: Rao, Mechanical Vibrations, ch. 1
TermType damper();

}  // namespace rvbench::sim
