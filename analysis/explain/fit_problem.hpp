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
///
/// Units   those of the parameters; residuals as the model has them
/// Errors  parameters_of(), and so this, throws std::out_of_range: no such effect; nothing else
/// Source  ours for the scatter; Gelman et al., Bayesian Data Analysis, ch. 14, for what is known
///         beforehand as further residuals
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
/// Errors, source  of FitProblem
double cost_of(const FitProblem& on, const std::vector<double>& values,
               const Eigen::VectorXd& residuals);

/// How many values the units learned from have.
/// Errors  none thrown
double values_learned(const FitProblem& on);

/// Share of the cost that is not worth another step.
/// Errors  none thrown. Source  ours: what differences and one value's error leave open
double negligible_gain(const FitProblem& on);

/// Of the residuals of units learned from, squared; 0 if there are none.
/// Units  of the residuals, squared. Errors  none thrown
double mean_square_of(const ForwardModel& model, const Eigen::VectorXd& residuals,
                      const std::vector<bool>& trained);

/// Root of mean_square_of(), 1 at least where residuals count standard errors.
/// Units, errors  of mean_square_of(); at least 1e-6 where they do not. Source  ours
double scatter_of(const ForwardModel& model, const Eigen::VectorXd& residuals,
                  const std::vector<bool>& trained);

/// Parameters of a model with some effects: of the base, then of each effect.
/// @throws std::out_of_range if the library has no such effect
std::vector<ModelParameter> parameters_of(const ForwardModel& model,
                                          const std::vector<std::size_t>& effects);

/// d residuals / d parameter, one column for each value, by differences.
/// @param held  of the first parameters, taken as they are
/// @return nothing where the model cannot be evaluated
/// Shape, units  residuals by values; theirs over that of the value
/// Source  Nocedal & Wright, Numerical Optimization (2006), ch. 8: forward differences
std::optional<Eigen::MatrixXd> jacobian(const FitProblem& on, const std::vector<double>& values,
                                        const Eigen::VectorXd& residuals,
                                        const Eigen::MatrixXd& held = {});

/// Half the curvature of the cost at these slopes, as linear residuals would have it; with what is
/// known of the parameters beforehand.
/// Shape   n x n for n values. Errors  none thrown
/// Source  Nocedal & Wright, Numerical Optimization (2006), ch. 10: JᵀJ
Eigen::MatrixXd information_of(const FitProblem& on, const Eigen::MatrixXd& slopes);

}  // namespace rvbench::analysis
