#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// How strongly a signal swings about its mean, and how evenly.
struct SignalLevels {
  double rms = 0;           ///< in the unit of the signal
  double peak = 0;          ///< largest distance from the mean, in the unit of the signal
  double crest_factor = 0;  ///< peak / rms: √2 for a sine; 0 for a constant
  double kurtosis = 0;      ///< 3 for Gaussian noise, 1.5 for a sine; 0 for a constant
};

/// Levels of all of a signal.
///
/// Shape   N >= 1 samples
/// Units   that of the signal; crest factor and kurtosis without
/// Errors  throws std::invalid_argument: N < 1, sample not finite
/// Source  ISO 13373-2:2016 for rms, peak and crest factor; Dyer & Stewart, J. Mech. Des. 100(2),
///         229-235 (1978) for kurtosis
SignalLevels signal_levels(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis
