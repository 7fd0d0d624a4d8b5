#pragma once

#include "analysis/explain/fit.hpp"

namespace rvbench::analysis {

/// How far what a fit predicts of another condition may be from what is measured there.
///
///     σ² = a + b·j·D·jᵀ                  j = d prediction / d values
///
/// D is the covariance of the fit's values by leaving one condition out after the other: what is
/// wrong with a condition, as a load known by its label only, is wrong with all that was recorded
/// under it. a and b are what the residuals of the conditions left out scatter by: everywhere, and
/// more where the values matter more.
/// Units   standard deviations of the measurement
/// Errors  throws std::invalid_argument: a fit without residuals
/// Limits  leaves out in one linear step, without a fit of its own; where two conditions of eight
///         hold most of the scatter, eight in ten are inside instead of nine
/// Source  Cameron & Miller, J. Human Resources 50(2), 317-372 (2015), §VI: jackknife by cluster,
///         degrees of freedom
class PredictiveError {
 public:
  /// @throws std::invalid_argument if the fit has no residuals
  PredictiveError(const ForwardModel& model, const Fit& fit);

  /// Half of the interval that holds nine predicted values in ten, over the standard deviation of
  /// the measurement. Student's, with the conditions that are beyond the number of the fit's
  /// values.
  /// @param slope  of the prediction by each of the fit's values, over that deviation
  double half_width_90(const Eigen::VectorXd& slope) const;

 private:
  Eigen::MatrixXd covariance_;  ///< D
  double everywhere_ = 0;       ///< a
  double grows_ = 0;            ///< b
  double freedom_ = 1;
};

}  // namespace rvbench::analysis
