#pragma once

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// What a judgement that is INVALID lacks.
enum class Lack {
  sound_data,      ///< records that can be trusted, of this machine
  limit_measured,  ///< a value to hold against a limit of the plan
  part_shown       ///< of one part whether it is good
};

/// What an INVALID judgement lacks: of several the first, which spoils what the next could say.
/// Errors  none thrown; meaningless of other endings. Source  ours
Lack lack_of(const Judgement& judgement);

/// True if the records cannot be trusted, or if nothing in them confirms the machine.
bool is_spoiled(const Judgement& judgement);

/// Whether what was found may be told as found, with how sure it is and what to do about it. If
/// not, it was seen in data that are refused, or by a run that did not come to its end: nothing is
/// said about the unit.
/// Errors  none thrown. Source  ours
bool findings_stand(const Judgement& judgement);

}  // namespace rvbench::bench
