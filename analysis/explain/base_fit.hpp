#pragma once

#include <vector>

#include "analysis/explain/fit.hpp"
#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// The model without any effect at rest on all of its units, from its nominal values.
///
/// Numbers that are off within their tolerances make lines wrong by many standard errors. Where the
/// model presses these, they pull no more than slight ones do, and the fit may rest where a few of
/// them are given up: it begins without pressing, too, and the lower end is taken.
/// @return without residuals if the model cannot be evaluated at its nominal values
/// Shape, units  all of the model's values; errors  none thrown
/// Source  ours; fit_from() for the fit, pressed() for the pressing
Fit fit_base(const ForwardModel& model, const std::vector<bool>& everything);

}  // namespace rvbench::analysis
