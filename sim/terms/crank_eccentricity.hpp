#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A crank whose eccentric is off: a line of the crank's turn against the carrier.
TermType crank_eccentricity();

}  // namespace rvbench::sim
