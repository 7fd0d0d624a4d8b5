#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// The pins are not where the cycloid expects them: lines of the lobe pass.
TermType pin_ripple();

}  // namespace rvbench::sim
