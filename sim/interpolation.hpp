#pragma once

#include <Eigen/Core>

namespace rvbench::sim {

/// Weights that give a band-limited signal, or a derivative of it, between its samples.
///
/// Windowed sinc (Blackman), symmetric: it shifts no phase. Straight lines and, for the second
/// derivative, parabolas come out exactly. At its ends a record is continued by reflection in its
/// first and last point.
class Interpolation {
 public:
  /// @param derivative  0, 1 or 2, per sample (per sample squared)
  /// @param fraction    where between two samples, [0, 1)
  /// @param cutoff      of what is let through, in cycles per sample, (0, 0.5]
  /// @throws std::invalid_argument if one of them is out of range
  Interpolation(int derivative, double fraction, double cutoff = 0.5);

  /// @param at  the value sought lies at index at + fraction
  double operator()(const Eigen::VectorXd& x, Eigen::Index at) const;

 private:
  Eigen::Index reach_;       ///< samples used on each side
  Eigen::VectorXd weights_;  ///< of x[at − reach_ .. at + reach_]
};

}  // namespace rvbench::sim
