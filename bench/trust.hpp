#pragma once

#include <string>

#include "bench/judgement.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// INVALID, and why. Errors  none thrown. Source  definition
Ending invalid(std::string reason);

/// Why the data cannot be trusted, PASS if they can: every point was recorded and is sound, and a
/// record is long enough to part the orders of what turned. Of one point that is not each reason is
/// said, in the order of what to mend first: the sensors, then the length of the record.
/// Errors  none thrown. Source  ours
Ending trust_in(const Judgement& judgement);

/// Whether trust_in() is PASS.
bool can_be_trusted(const Judgement& judgement);

}  // namespace rvbench::bench
