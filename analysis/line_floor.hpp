#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Power of a spectrum and of the noise around each of its lines.
///
/// The floor of a line is the median power of its neighbours, as the mean of the exponential
/// distribution that noise lines have. The nearer to line 0, the fewer neighbours: the envelope of
/// a narrow mode falls within few lines. Lines on, or next to, multiples of `locked_every` are left
/// out where enough others remain: a gear train puts power on all of them.
struct LineFloor {
  Eigen::VectorXd power;        ///< amplitude², in the unit of the signal squared
  Eigen::VectorXd floor;        ///< the same unit; > 0
  Eigen::VectorXd floor_lines;  ///< independent lines that each floor value is worth
  Eigen::VectorXd neighbours;   ///< lines whose median each floor value is
  Eigen::Index locked_every = 0;

  /// How much better a line of free amplitude and phase explains its power than noise does.
  ///
  ///     m·ln(1 + X/(m·F))  →  X/F   for a floor F that is known well
  ///
  /// With X the power of the line and m the independent lines that its floor is worth. It is also
  /// −ln p of the line: X/F of noise is F-distributed with 2 and 2m degrees of freedom, and its
  /// logarithm exponentially distributed with mean 1.
  /// Source  Kay, Fundamentals of Statistical Signal Processing, vol. 2 (1998), ch. 6 and 9: GLRT
  /// of
  ///         a sinusoid in noise of unknown level
  double log_ratio(Eigen::Index line) const;

  /// Whether a line is one of the neighbours of the floors around it, its own among them.
  bool is_neighbour(Eigen::Index line) const;

  /// Whether a line cannot be told from a multiple of `locked_every`. Never where those are dense.
  bool is_locked(Eigen::Index line) const;
};

/// @param locked_every  lines from one shaft-locked line to the next; 0: there are none
/// Shape   N lines → N each; at least one
/// Units   those of the spectrum, squared
/// Errors  none thrown; where nothing is there the floor is the least that keeps ratios finite
/// Source  ours: the median of an exponential distribution is ln 2 of its mean
LineFloor line_floor(const Spectrum& spectrum, Eigen::Index locked_every);

/// The same, with the floor taken from the lines that are not among `left_out`, one flag per line.
LineFloor line_floor(const Spectrum& spectrum, const std::vector<bool>& left_out);

}  // namespace rvbench::analysis
