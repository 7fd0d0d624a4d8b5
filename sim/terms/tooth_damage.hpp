#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A tooth of a planet that has lost part of its flank: a knock once per turn.
TermType tooth_damage();

}  // namespace rvbench::sim
