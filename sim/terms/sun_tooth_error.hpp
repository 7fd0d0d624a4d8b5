#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Profile errors of the input shaft's teeth, which go round with it: worn, bent or badly ground.
TermType sun_tooth_error();

}  // namespace rvbench::sim
