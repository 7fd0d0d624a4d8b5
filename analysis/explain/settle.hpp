#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/explain/fit_problem.hpp"

namespace rvbench::analysis {

/// Values with the residuals of all units there.
struct Evaluated {
  std::vector<double> values;
  Eigen::VectorXd residuals;  ///< empty if the model cannot be evaluated
};

/// Where one Gauss-Newton step leads, if the model is as straight as its slopes.
/// Units   those of the parameters. Errors  none thrown
/// Source  Nocedal & Wright, Numerical Optimization (2006), ch. 10: Gauss-Newton, within bounds
Evaluated forecast(const FitProblem& on, const Evaluated& from, const Eigen::MatrixXd& slopes);

/// Goes to rest from where a fit on nearly the same units did, by Gauss-Newton steps with its
/// slopes: one evaluation for each step.
/// @return nothing if it does not come to rest that way
/// Units, errors, source  of forecast()
std::optional<Evaluated> settle(const FitProblem& on, const Evaluated& from,
                                const Eigen::MatrixXd& slopes);

}  // namespace rvbench::analysis
