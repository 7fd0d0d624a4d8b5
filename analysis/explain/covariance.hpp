#pragma once

#include "analysis/explain/fit.hpp"
#include "analysis/explain/fit_problem.hpp"

namespace rvbench::analysis {

/// Gives a fit its covariance and its freedom, of its residuals and slopes.
///
/// A number that was known beforehand is learned only in part: by as much as the units tell more
/// of it.
void add_covariance(const FitProblem& on, Fit& fit);

}  // namespace rvbench::analysis
