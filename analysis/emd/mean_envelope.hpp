#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/emd/knots.hpp"
#include "analysis/emd/sift_kernels.hpp"

namespace rvbench::analysis {

/// What closes a cubic spline: no curvature at its ends, or a third derivative that does not jump
/// at the last knots but one (de Boor, A Practical Guide to Splines, ch. IV).
enum class SplineEnds { natural, not_a_knot };

/// The mean of the two envelopes of a signal that becomes known from left to right.
///
/// The upper envelope is the cubic spline through the maxima, the lower one that through the
/// minima. Both are single cubics between an extremum and the next one of the other kind, so their
/// mean is, too: neither envelope is ever laid out in samples.
///
/// A spline forgets: what a knot does to it falls by about 2 - √3 from knot to knot. So its cubics
/// are settled, block by block of knots, once those that follow leave less than 1e-17 of whatever
/// comes later. Where a block is settled depends on the knots alone, and not on when they came.
///
/// Units   samples and the signal's own. Errors  none thrown: there are 3 knots and more
/// Source  de Boor, A Practical Guide to Splines, ch. IV; that it settles is ours
class MeanEnvelope {
 public:
  /// Forgets all that it knew.
  /// @param block  of knots that are settled at once: large ones cost less, small ones come sooner
  void begin(std::size_t block, SplineEnds spline = SplineEnds::natural);

  /// Subtracts from h what is settled of it. The knots have been mirrored at the start.
  /// @return samples that are done; of the others none was touched
  Eigen::Index subtract_settled(const SiftKernels& kernels, double* h, Knots& knots);

  /// Subtracts the rest: the knots have been mirrored at the end, too.
  void subtract_rest(const SiftKernels& kernels, double* h, Eigen::Index samples, Knots& knots);

  void rebase(Eigen::Index samples) { done_ -= samples; }  ///< that many are gone from the front

 private:
  void make_room(const Knots& knots);
  double chord(const Knots& knots, std::size_t j);
  bool begins(const Knots& knots);
  void eliminate(const Knots& knots);
  void open_rows_not_a_knot(const Knots& knots);
  void close_rows_not_a_knot(const Knots& knots);
  double curvature_beyond(const Knots& knots, std::size_t outermost, std::size_t next,
                          std::size_t after) const;
  void curve_start(const Knots& knots);
  void curve_end(const Knots& knots);
  bool finds_block_settled();
  void settle_block(const Knots& knots);
  void subtract(const SiftKernels& kernels, double* h, const Knots& knots, std::size_t until,
                Eigen::Index samples);
  void drop_spent(Knots& knots);

  std::size_t block_ = 1;
  SplineEnds spline_ = SplineEnds::natural;
  std::vector<double> curvature_;      ///< second derivative of its own envelope at each knot
  std::vector<double> elimination_;    ///< what the forward pass leaves for the backward one
  std::vector<double> inverse_width_;  ///< 1 / distance to the next knot of the same envelope
  bool has_begun_ = false;
  std::size_t eliminated_ = 0;  ///< the forward pass has come so far
  std::size_t settled_ = 0;     ///< the curvature of those before is final
  std::size_t first_ = 0;       ///< of all knots
  std::size_t next_ = 0;        ///< the mean is subtracted up to this knot
  std::size_t probed_ = 0;      ///< how far it was looked whether the block is settled
  double left_[2] = {1, 1};     ///< what is left there of what comes later, of either envelope
  double chord_[2] = {0, 0};    ///< of the two knots before, one of each envelope
  double taken_[2] = {0, 0};    ///< what their rows take from the next pivots
  Eigen::Index done_ = 0;
};

}  // namespace rvbench::analysis
