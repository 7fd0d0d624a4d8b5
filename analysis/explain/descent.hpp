#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// Least squares of a model with some effects, learned from some of its units.
///
/// Where a model that lacks physics misses its values by more than their errors, it says less of
/// its parameters: residuals then weigh, against what is known beforehand, as if their errors were
/// as large as that scatter.
struct FitProblem {
  const ForwardModel& model;
  const std::vector<std::size_t>& effects;  ///< indices into the model's library
  const std::vector<bool>& trained;         ///< per unit: whether it is learned from
  double scatter;                           ///< of residuals, >= 1
  std::vector<ModelParameter> parameters;   ///< of the base, then of each effect

  /// The first three outlive it.
  FitProblem(const ForwardModel& model, const std::vector<std::size_t>& effects,
             const std::vector<bool>& trained, double scatter);
};

/// Root mean square of the residuals of units learned from, 1 at least.
double scatter_of(const ForwardModel& model, const Eigen::VectorXd& residuals,
                  const std::vector<bool>& trained);

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
/// the other.
/// @param known  what is not looked for anew: where these slopes do not change much, each step
/// costs
///               as many evaluations as there are other parameters, and one
Descent descend(const FitProblem& on, std::vector<double> values, int iterations,
                const KnownSlopes& known = {});

/// Values with the residuals of all units there.
struct Evaluated {
  std::vector<double> values;
  Eigen::VectorXd residuals;  ///< empty if the model cannot be evaluated
};

/// Where one Gauss-Newton step leads, if the model is as straight as its slopes.
Evaluated forecast(const FitProblem& on, const Evaluated& from, const Eigen::MatrixXd& slopes);

/// Goes to rest from where a fit on nearly the same units did, by Gauss-Newton steps with its
/// slopes: one evaluation for each step.
/// @return nothing if it does not come to rest that way
std::optional<Evaluated> settle(const FitProblem& on, const Evaluated& from,
                                const Eigen::MatrixXd& slopes);

}  // namespace rvbench::analysis
