#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// What a signal does in every period of a shaft, or of a gear train, alike; and how surely.
struct SynchronousAverage {
  Eigen::Index periods = 0;
  Eigen::VectorXd average;         ///< one period, in the unit of the signal
  Eigen::VectorXd standard_error;  ///< of each sample of it
  Eigen::VectorXcd lines;          ///< of the average, k times per period; magnitudes 0-to-peak
  Eigen::VectorXd line_error;      ///< standard error of real and of imaginary part of each line

  /// Probability that noise alone averages to such a line: it is the same in all periods by chance.
  /// @param line  of `lines`  @throws std::invalid_argument if there is no such line
  double p_value(Eigen::Index line) const;
};

/// Averages whole periods of a signal over angle. Over one output turn of an RV reducer, 121 input
/// turns for an RV-20E, every line that its gears can make stays, and all else falls with the
/// number of periods; over a turn of one shaft, see ShaftAngle::geared(), only what that shaft
/// does.
///
///     x̄_i = 1/P Σ_p x_p,i        X̄_k = 1/P Σ_p X_p,k        s_k² = Σ_p |X_p,k − X̄_k|² / (2P(P −
///     1))
///
/// Shape    P · samples_per_period samples → one period, and samples_per_period / 2 + 1 lines
/// Units    those of x
/// Errors   throws std::invalid_argument: x is not at least two whole periods of at least 2
///          samples, a sample is not finite
/// Limits   a line that no period shares is damped by |sin(πPf)/(P·sin πf)|, f cycles per period:
///          to 1/P at the worst, 0 if f·P is whole. Its errors take noise for alike in all periods
/// Source   McFadden, Mech. Syst. Signal Process. 1(1), 83-95 (1987): the average as a comb filter
SynchronousAverage synchronous_average(const Eigen::Ref<const Eigen::VectorXd>& x,
                                       Eigen::Index samples_per_period);

/// What is left of x when the average period is taken out of each: all that no period shares.
///
/// Shape, units, errors, source  of synchronous_average(); one period is enough, and leaves nothing
Eigen::VectorXd without_average(const Eigen::Ref<const Eigen::VectorXd>& x,
                                Eigen::Index samples_per_period);

}  // namespace rvbench::analysis
