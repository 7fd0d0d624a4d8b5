#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// A line found in a spectrum, and the lines around that stand out with it.
struct Peak {
  Eigen::Index from, to;
  bool holds(Eigen::Index line) const { return line >= from && line <= to; }
};

/// A Hann spectrum in which peaks are looked for.
///
/// Units   orders; powers over their floor
/// Errors  none thrown; lines must be below size()
/// Source  ours; what stands out: line_level() and line_p_value(), up to seen_p
class SpectralPeaks {
 public:
  /// @param spectrum, floor  must outlive this
  /// @param blocks           independent ones that the spectrum is the mean of, in power; >= 1
  SpectralPeaks(const Spectrum& spectrum, const LineFloor& floor, double blocks);

  Eigen::Index size() const { return log_ratio_.size(); }
  double resolution() const { return spectrum_.resolution; }
  Eigen::Index line_of(double order) const;
  /// Whether a peak at the order has a neighbour above it.
  bool reaches(double order) const { return line_of(order) + 2 < size(); }
  /// ln(power / floor), 0 below the floor.
  double log_ratio(Eigen::Index line) const { return log_ratio_[line]; }
  /// What stands out of the noise at an order: as wide as a Hann line at least, as far as it is
  /// smeared at most.
  /// @param smear  relative
  std::optional<Peak> at(double order, double smear) const;

 private:
  bool stands_out(Eigen::Index line) const;

  const Spectrum& spectrum_;
  const LineFloor& floor_;
  double blocks_;
  Eigen::ArrayXd log_ratio_;
};

}  // namespace rvbench::analysis
