#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// The teeth of sun and planets stray from the involute alike: mesh lines that no load needs.
TermType transmission_error();

}  // namespace rvbench::sim
