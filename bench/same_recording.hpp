#pragma once

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// Whether two points were judged by the same samples: more than half of the channels that one of
/// them has are in the other, too, with the same rms, peak and kurtosis. A copy may have another
/// name, other channels beside them, or samples with fewer digits.
/// Errors  none thrown. Source  definition
bool are_of_one_recording(const JudgedPoint& one, const JudgedPoint& other);

/// Whether any of the points of one judgement is of the same recording as any of the other's.
bool share_a_recording(const Judgement& one, const Judgement& other);

}  // namespace rvbench::bench
