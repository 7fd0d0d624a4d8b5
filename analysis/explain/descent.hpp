#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/explain/fit_problem.hpp"

namespace rvbench::analysis {

/// Where a descent ended.
struct Descent {
  std::vector<double> values;
  double cost = 0;  ///< sum of squares over the units learned from, and of what is known beforehand
  bool converged = false;
  Eigen::VectorXd residuals;  ///< of all units, with the slopes there, held ones among them;
  Eigen::MatrixXd slopes;     ///< both empty if the last step was not followed by new ones
};

/// Levenberg-Marquardt within the parameters' bounds.
/// @param held  slopes of the first parameters, good enough not to be looked for anew: where they
///              hardly change, each step costs as many evaluations as there are other parameters,
///              and one
/// @param negligible  part of the cost: who wins less with a step is at rest; 0 is as exact as
///                    differences allow
/// Units   those of the parameters; stepped in their scales
/// Errors  none thrown; not converged where the model cannot be evaluated
/// Source  Marquardt, J. Soc. Ind. Appl. Math. 11(2), 431-441 (1963), as Ceres has it
Descent descend(const FitProblem& on, std::vector<double> values, int iterations,
                const Eigen::MatrixXd& held = {}, double negligible = 0);

}  // namespace rvbench::analysis
