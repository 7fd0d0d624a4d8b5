#pragma once

#include <string>

#include "analysis/explain/fit.hpp"
#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// Why the base of a fit cannot be trusted: a parameter that had to leave what is known of it, by
/// more than its own error leaves open. One that is known within bounds alone, and of which these
/// data tell less than they do, says nothing by lying at one.
/// One that is bounded to one side only is bounded by physics, not by knowledge: zero says nothing
/// against it.
/// @return empty if it can be trusted
/// Units   in the text: those of the parameter. Errors  none thrown. Source  ours
std::string miscalibration(const ForwardModel& model, const Fit& fit);

}  // namespace rvbench::analysis
