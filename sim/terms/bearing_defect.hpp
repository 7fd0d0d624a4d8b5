#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A spall on one part of a rolling bearing that the plant has: each pass is a blow on the housing.
/// See rolling_bearing() for its law.
///
/// Leaves out: a second spall on the same bearing
/// Source: McFadden & Smith, J. Sound Vib. 96(1), 69-82 (1984)
TermType bearing_defect();

}  // namespace rvbench::sim
