#pragma once

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// What the limits make of the findings, with the reason. A limit that could not be held against
/// the data outweighs one that is exceeded, but both are said.
/// Errors  none thrown. Source  which ending is the graver: README, exit codes
Ending ending_by_limits(const Judgement& judgement);

}  // namespace rvbench::bench
