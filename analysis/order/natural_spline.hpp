#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// The smoothest curve through points of a function: cubic pieces, straight at both ends.
///
/// Units    those of the points
/// Limits   away from the ends within (5/384)·h⁴·max|f⁗| of f, h the longest step; at the ends
///          within h²·max|f″|/8
/// Source   de Boor, A Practical Guide to Splines, ch. IV-V; Hall & Meyer, J. Approx. Theory 16,
///          105-122 (1976), for the bound
class NaturalSpline {
 public:
  /// @param at  rising, as many as values, at least two
  /// @throws std::invalid_argument
  NaturalSpline(Eigen::VectorXd at, Eigen::VectorXd values);

  double operator()(double where) const;  ///< straight on beyond the ends
  double integral(double where) const;    ///< from the first point on; the same beyond the ends

 private:
  Eigen::Index piece_of(double where) const;
  double integral_over(Eigen::Index piece, double from_start) const;

  Eigen::VectorXd at_, values_, bends_;  ///< second derivatives
  Eigen::VectorXd sums_;                 ///< integral up to each point
};

}  // namespace rvbench::analysis
