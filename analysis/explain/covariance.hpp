#pragma once

#include "analysis/explain/fit.hpp"
#include "analysis/explain/fit_problem.hpp"

namespace rvbench::analysis {

/// Gives a fit its covariance and its freedom, of its residuals and slopes.
///
/// A number that was known beforehand is learned only in part: by as much as the units tell more
/// of it.
/// Shape, units  n x n for n values; of as_waves(values), two by two. Errors  none thrown
/// Source  Liang & Zeger, Biometrika 73(1), 13-22 (1986)
void add_covariance(const FitProblem& on, Fit& fit);

/// Variance of each number by the slopes alone, where residuals count standard errors: how far they
/// scatter is known, and need not be learned from units, of which there may be few.
/// Shape, units  one per value, its unit squared. Errors  none thrown
/// Source  Draper & Smith, Applied Regression Analysis (1998): least squares, variance known
Eigen::VectorXd known_variances(const FitProblem& on, const Fit& fit);

}  // namespace rvbench::analysis
