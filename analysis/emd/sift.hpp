#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "analysis/emd/end_rule.hpp"
#include "analysis/emd/extrema.hpp"
#include "analysis/emd/mean_envelope.hpp"

namespace rvbench::analysis {

/// Fewer are no oscillation: a maximum between two minima is the least.
inline constexpr std::size_t least_extrema = 3;

/// How envelopes are drawn.
struct SiftRule {
  const EndRule* ends = &averaged_ends();
  SplineEnds spline = SplineEnds::natural;
};

/// One sift: a signal loses the mean of its envelopes, in place, as it becomes known from left to
/// right. What comes out does not depend on the steps in which it became known, to the bit.
///
/// Units   those of the signal. Errors  none thrown: samples are finite
/// Source  Huang et al., Proc. R. Soc. A 454, 903-995 (1998), sec. 5
class Sift {
 public:
  Sift(const SiftRule& rule, const SiftKernels& kernels) : rule_(rule), kernels_(&kernels) {}

  /// A new signal. @param block  of knots that are settled at once, see MeanEnvelope
  void begin(std::size_t block);

  /// Sifts what samples [0, known) of h allow, and with `is_end` all: there are no more. A signal
  /// of less than three extrema has no envelopes and stays as it is.
  /// @return samples that are done; the others are still as they were
  Eigen::Index advance(double* h, Eigen::Index known, bool is_end);

  /// That many samples are gone from the front of h, all of which were done.
  void rebase(Eigen::Index samples);

  std::size_t extrema() const { return extrema_; }  ///< of the signal, found so far

 private:
  SiftRule rule_;
  const SiftKernels* kernels_;
  ExtremaScan scan_;
  Knots knots_;
  MeanEnvelope mean_;
  std::size_t extrema_ = 0;
  bool has_start_ = false;
};

}  // namespace rvbench::analysis
