#pragma once

#include <string>

#include "bench/judgement.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// Holds a limit against the worst that was measured, over all points and channels; for
/// modulation_depth over all findings. What was not measured anywhere, or not in a unit that leads
/// to the limit's, leaves `measured` NaN, and is not passed.
LimitCheck check_of(const sequences::Limit& limit, const Judgement& judgement);

/// The bound that a check has, from above or from below.
double bound_of(const LimitCheck& check);

/// "above" or "below": where a value is that does not keep to it.
const char* beyond(const LimitCheck& check);

/// "1.9 g"; of a pure number the number alone.
std::string with_unit(double value, const std::string& unit);

/// "fm4 of sun-planet mesh, sun against carrier"
std::string name_of(const LimitCheck& check);

}  // namespace rvbench::bench
