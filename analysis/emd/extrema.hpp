#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "analysis/emd/knots.hpp"
#include "analysis/emd/sift_kernels.hpp"

namespace rvbench::analysis {

/// Finds the interior extrema of a signal that becomes known from left to right. Maxima and minima
/// alternate; a plateau counts as one extremum at its middle.
///
/// Units   samples and the signal's own. Errors  none thrown: samples are finite
/// Source  ours: quantised signals have plateaus, and an extremum at either edge would be two
class ExtremaScan {
 public:
  /// Appends to `found` those that samples [0, known) show and fewer samples did not.
  void advance(const SiftKernels& kernels, const double* samples, Eigen::Index known, Knots& found);

  void rebase(Eigen::Index samples);  ///< that many are gone from the front

 private:
  ScanState state_;
  bool has_moved_ = false;
};

/// How many interior extrema a signal has, as ExtremaScan finds them.
/// Shape   N → one; 0 for less than 3. Errors, source  of ExtremaScan
std::size_t count_extrema(const Eigen::VectorXd& x);

}  // namespace rvbench::analysis
