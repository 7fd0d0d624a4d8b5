#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/judgement.hpp"
#include "bench/stored_run.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// Why a run cannot be judged again; empty if it can: it ended ERROR or ABORTED, so that the bench,
/// not the limits, decided.
std::string why_not_judged_again(const StoredRun& run);

/// Judges the recordings of a run again, by this version of rvbench.
/// @param limits    in place of the plan's  @param progress  is told the share that is done
/// Units  of each limit. Errors  none thrown: a record that cannot be read is a point not judged,
///        and the judgement INVALID or ERROR. Source  judge_point(), conclude()
Judgement judged_again(const StoredRun& run, const std::vector<sequences::Limit>& limits,
                       const std::function<void(double)>& progress);

/// The same limits held against what verdict.json says was measured: no recording is read, and the
/// software that examined them stays the one of then.
Judgement judged_by_limits(const StoredRun& run, const std::vector<sequences::Limit>& limits);

/// How a run ends by the limits of its own plan, and by others.
struct EndingsByLimits {
  Ending by_own, by_others;
};

/// judged_by_limits() by both; what they have in common is concluded once.
EndingsByLimits endings_by_limits(const StoredRun& run,
                                  const std::vector<sequences::Limit>& others);

}  // namespace rvbench::bench
