#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// Least squares of a model with some effects, learned from some of its units.
///
/// Where a model that lacks physics misses its values by more than their errors, it says less of
/// its parameters: residuals then weigh, against what is known beforehand, as if their errors were
/// as large as that scatter. Where residuals do not count errors, their scatter is all that is
/// known of these.
struct FitProblem {
  const ForwardModel& model;
  const std::vector<std::size_t>& effects;  ///< indices into the model's library
  const std::vector<bool>& trained;         ///< per unit: whether it is learned from
  double scatter;                           ///< see scatter_of()
  std::vector<ModelParameter> parameters;   ///< of the base, then of each effect

  /// The first three outlive it.
  FitProblem(const ForwardModel& model, const std::vector<std::size_t>& effects,
             const std::vector<bool>& trained, double scatter);
};

/// What is known of the parameters beforehand, as further residuals: (value − nominal) / spread,
/// times the scatter of the others.
struct Prior {
  std::vector<std::size_t> of;
  std::vector<double> nominal, spread;

  explicit Prior(const FitProblem& on);
  double residual(std::size_t i, const std::vector<double>& values) const {
    return (values[of[i]] - nominal[i]) / spread[i];
  }
  double cost(const std::vector<double>& values) const;
};

/// Sum of squares over the units learned from, and of what is known beforehand.
double cost_of(const FitProblem& on, const std::vector<double>& values,
               const Eigen::VectorXd& residuals);

/// How many values the units learned from have.
double values_learned(const FitProblem& on);

/// Share of the cost that is not worth another step.
double negligible_gain(const FitProblem& on);

/// Of the residuals of units learned from, squared; 0 if there are none.
double mean_square_of(const ForwardModel& model, const Eigen::VectorXd& residuals,
                      const std::vector<bool>& trained);

/// Root of mean_square_of(), 1 at least where residuals count standard errors.
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

}  // namespace rvbench::analysis
