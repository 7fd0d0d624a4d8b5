#pragma once

#include <string>

#include "bench/judgement.hpp"
#include "sequences/plan.hpp"

/// Limits of a plan, held against what was measured.
/// Units   of each limit. Errors  none thrown
/// Source  the bounds are the plan's; what counts as measured is ours
namespace rvbench::bench {

/// Holds a limit against the worst that was measured, over all channels of the points it is for;
/// for modulation_depth over all findings. What could not be measured at a point, or not in a unit
/// that leads to the limit's, is not passed: see is_measured().
LimitCheck check_of(const sequences::Limit& limit, const Judgement& judgement);

/// Whether the limit could be held against every point, or, of what a sound record may lack,
/// against any.
bool is_measured(const LimitCheck& check);

/// Whether what was measured is on the wrong side of the bound; false of nothing.
bool is_beyond(const LimitCheck& check);

/// The bound that a check has, from above or from below.
double bound_of(const LimitCheck& check);
const char* bound_name(const LimitCheck& check);  ///< "max" or "min", as in the plan
std::string bound_text(const LimitCheck& check);  ///< "max 1.5 g"

/// Measured over bound, or bound over measured for a bound from below: 1 at the bound, more beyond,
/// infinite if is_measured() is false.
double share_of_bound(const LimitCheck& check);

/// "above" or "below": where a value is that does not keep to it.
const char* beyond(const LimitCheck& check);

/// "1.9 g"; of a pure number the number alone.
std::string with_unit(double value, const std::string& unit);

/// "fm4 of sun-planet mesh, sun against carrier", "kurtosis at 1815 rpm, 100 % load"
std::string name_of(const LimitCheck& check);

/// "measured at 12 of 21 points"; empty if it was at all of them.
std::string coverage_of(const LimitCheck& check);

/// "could not be measured in g at 2 of 21 points"; "could not be measured in g" of none at
/// all, and when that is so of a sound unit.
std::string why_unmeasured(const LimitCheck& check);

/// ", first recording.h5#003, accel_1x", where that was so at some points and not at others.
std::string first_lacking(const LimitCheck& check);

}  // namespace rvbench::bench
