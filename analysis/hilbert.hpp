#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Magnitude of the analytic signal of x: its envelope.
///
/// Shape   N → N; any N, even primes
/// Units   those of x
/// Limits  x is taken as periodic: the first and last cycles see each other
/// Errors  throws std::invalid_argument: N < 4, sample not finite
/// Source  Marple, IEEE Trans. Signal Process. 47(9), 2600-2603 (1999)
Eigen::VectorXd envelope(const Eigen::Ref<const Eigen::VectorXd>& x);

/// Rate of the phase of the analytic signal of x, at each sample the mean of the steps to both
/// neighbours. It means something where x swings about zero in one way at a time, as an IMF does;
/// elsewhere it may even be negative.
///
/// Shape, limits, errors  of envelope(), and throws for rate_Hz not finite and positive
/// Units   Hz, from -rate_Hz / 2 to rate_Hz / 2
/// Source  Huang et al., Proc. R. Soc. A 454, 903-995 (1998), sec. 3
Eigen::VectorXd instantaneous_frequency_Hz(const Eigen::Ref<const Eigen::VectorXd>& x,
                                           double rate_Hz);

/// An analytic signal, told by its magnitude and the rate of its phase.
struct AnalyticSignal {
  Eigen::VectorXd envelope;      ///< in the unit of the signal
  Eigen::VectorXd frequency_Hz;  ///< instantaneous
};

/// envelope() and instantaneous_frequency_Hz() of x, to the bit, for the price of one.
///
/// Shape, units, limits, errors, source  of these
AnalyticSignal analytic_signal(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz);

/// Mean frequency of x by half of its zero crossings: the carrier of a narrow band or an IMF.
///
/// Shape  N → one; 0 for N < 2
/// Units  those of the rate: Hz, or orders for samples per turn
/// Errors none thrown
/// Source Rice, Bell Syst. Tech. J. 24(1), 46-156 (1945), sec. 3.3
double crossing_frequency(const Eigen::Ref<const Eigen::VectorXd>& x, double rate);

}  // namespace rvbench::analysis
