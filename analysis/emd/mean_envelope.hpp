#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/emd/extrema.hpp"

namespace rvbench::analysis {

/// The mean of the two envelopes of a signal, piecewise cubic.
///
/// The upper envelope is the natural cubic spline through the maxima, the lower one that through
/// the minima. Both are single cubics between an extremum and the next one of the other kind, so
/// their mean is, too: neither envelope is ever laid out in samples.
class MeanEnvelope {
 public:
  /// Subtracts from h the mean of the envelopes through `extrema`, which span h.
  ///
  /// Shape  at least 4 extrema, alternating, the first two at or before sample 0, the last two at
  ///        or after the last sample
  void subtract_from(Eigen::Ref<Eigen::VectorXd> h, const Extrema& extrema);

 private:
  void solve(const Extrema& extrema);

  std::vector<double> curvature_;      ///< second derivative of its own envelope at each extremum
  std::vector<double> elimination_;    ///< what the forward pass leaves for the backward one
  std::vector<double> inverse_width_;  ///< 1 / distance to the next knot of the same envelope
};

}  // namespace rvbench::analysis
