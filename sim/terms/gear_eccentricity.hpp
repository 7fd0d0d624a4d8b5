#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A planet that runs out: a line of its own turn, sidebands around the mesh.
TermType gear_eccentricity();

}  // namespace rvbench::sim
