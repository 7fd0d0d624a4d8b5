#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// Least squares of a model with some effects, learned from some of its units.
struct FitProblem {
  const ForwardModel& model;
  const std::vector<std::size_t>& effects;  ///< indices into the model's library
  const std::vector<bool>& trained;         ///< per unit: whether it is learned from
  std::vector<ModelParameter> parameters;   ///< of the base, then of each effect

  /// All three outlive it.
  FitProblem(const ForwardModel& model, const std::vector<std::size_t>& effects,
             const std::vector<bool>& trained);
};

/// Parameters of a model with some effects: of the base, then of each effect.
std::vector<ModelParameter> parameters_of(const ForwardModel& model,
                                          const std::vector<std::size_t>& effects);

/// d residuals / d parameter, one column for each value, by differences.
/// @param held  of the first parameters, taken as they are
/// @return nothing where the model cannot be evaluated
std::optional<Eigen::MatrixXd> jacobian(const FitProblem& on, const std::vector<double>& values,
                                        const Eigen::VectorXd& residuals,
                                        const Eigen::MatrixXd& held = {});

/// Half the curvature of the cost at these slopes, as linear residuals would have it; with what is
/// known of the parameters beforehand.
Eigen::MatrixXd information_of(const FitProblem& on, const Eigen::MatrixXd& slopes);

/// Where a descent ended.
struct Descent {
  std::vector<double> values;
  double cost = 0;  ///< sum of squares over the units learned from, and of what is known beforehand
  bool converged = false;
  Eigen::VectorXd residuals;  ///< of all units, with the slopes there; both empty if slopes were
  Eigen::MatrixXd slopes;     ///< held, or the last step was not followed by new ones
};

/// Levenberg-Marquardt within the parameters' bounds.
/// @param held  slopes of the first parameters, which are not looked for anew: where these do not
///              move far, each step costs as many evaluations as there are others, and one
Descent descend(const FitProblem& on, std::vector<double> values, int iterations,
                const Eigen::MatrixXd& held = {});

/// Values with the residuals of all units there.
struct Evaluated {
  std::vector<double> values;
  Eigen::VectorXd residuals;  ///< empty if the model cannot be evaluated
};

/// Goes to rest from where a fit on nearly the same units did, by Gauss-Newton steps with its
/// slopes: one evaluation for each step.
/// @return nothing if it does not come to rest that way
std::optional<Evaluated> settle(const FitProblem& on, const Evaluated& from,
                                const Eigen::MatrixXd& slopes);

}  // namespace rvbench::analysis
