#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>

namespace rvbench::test {

/// 0, 1/rate, 2/rate ...: n of them.
inline Eigen::ArrayXd times_s(Eigen::Index n, double rate_Hz) {
  return Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1)) / rate_Hz;
}

/// cos(2π·frequency·t + phase)
inline Eigen::VectorXd tone(double frequency_Hz, Eigen::Index n, double rate_Hz,
                            double phase_rad = 0) {
  return (2 * std::numbers::pi * frequency_Hz * times_s(n, rate_Hz) + phase_rad).cos();
}

struct RingingSpec {
  double carrier_Hz, rate_Hz, depth;
};

/// A carrier whose amplitude is 1 + depth·cos(2π·rate·t): n samples of an exactly known envelope.
inline Eigen::VectorXd ringing(RingingSpec s, Eigen::Index n, double rate_Hz) {
  return (1 + s.depth * tone(s.rate_Hz, n, rate_Hz).array()) *
         tone(s.carrier_Hz, n, rate_Hz).array();
}

/// Gaussian, of variance 1.
inline Eigen::VectorXd white_noise(Eigen::Index n, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian;
  return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index) { return gaussian(generator); });
}

inline double rms(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

}  // namespace rvbench::test
