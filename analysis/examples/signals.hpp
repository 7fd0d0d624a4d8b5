#pragma once

#include <Eigen/Core>

namespace rvbench::analysis::examples {

/// 0, 1/rate, 2/rate ...: n of them.
Eigen::ArrayXd times_s(Eigen::Index n, double rate_Hz);

/// cos(2π·cycles), of amplitude 1.
Eigen::VectorXd wave(const Eigen::ArrayXd& cycles);

/// Gaussian noise of variance 1.
Eigen::VectorXd noise(Eigen::Index n, unsigned seed);

/// What is struck, how often, and how it rings.
struct Strikes {
  double rate_Hz = 8000;  ///< of the samples
  double every_s = 1.0 / 83;
  double slip = 0.01;  ///< of the time between two: standard deviation, uncorrelated
  double resonance_Hz = 2900;
  double decay_s = 1.5e-3;
};

/// Decaying oscillations of height 1, each from where it is struck on.
Eigen::VectorXd struck(const Strikes& strikes, Eigen::Index n, unsigned seed);

double rms(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis::examples
