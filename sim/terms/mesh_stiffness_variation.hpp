#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// One and two pairs of teeth share the load in turn: mesh lines that grow with it.
TermType mesh_stiffness_variation();

}  // namespace rvbench::sim
