#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
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
  std::shared_ptr<const ForwardModel> stand_in;  ///< of the model, there; nullptr if it has none
};

/// What is known of a model's slopes from a fit of some of its effects: the first columns, and a
/// stand-in of the model if it has one. Either may be empty.
struct KnownSlopes {
  Eigen::MatrixXd held = {};
  std::shared_ptr<const ForwardModel> stand_in = {};
};

/// Levenberg-Marquardt within the parameters' bounds; of a model that has stand-ins, on one after
/// the other, which keep the slopes of the place before until these lead no further.
/// @param known  what is not looked for anew: where these slopes do not change much, each step
///               costs as many evaluations as there are other parameters, and one. A stand-in's
///               stay as they are: it rests where they see no step
Descent descend(const FitProblem& on, std::vector<double> values, int iterations,
                const KnownSlopes& known = {});

}  // namespace rvbench::analysis
