#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>

namespace rvbench::test {

/// A resonance that is struck again and again, each time by the same.
struct Strikes {
  double rate_Hz = 0;       ///< of sampling
  double repeated_Hz = 0;   ///< strikes per second
  double resonance_Hz = 0;  ///< that rings with them
  double decay_1_s = 0;     ///< after a strike the ringing falls as exp(-decay·t)
  double slip = 0;          ///< standard deviation of the time between strikes, over its mean

  Eigen::VectorXd samples(Eigen::Index n, unsigned seed = 1) const {
    std::mt19937 generator(seed);
    std::normal_distribution<double> gaussian;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    const auto rings = static_cast<Eigen::Index>(12 / decay_1_s * rate_Hz);
    double struck_s = 0.37 / repeated_Hz;
    while (struck_s * rate_Hz < double(n)) {
      const auto first = static_cast<Eigen::Index>(std::ceil(struck_s * rate_Hz));
      for (Eigen::Index i = first; i < std::min(n, first + rings); ++i) {
        const double t_s = double(i) / rate_Hz - struck_s;
        x[i] += std::exp(-decay_1_s * t_s) * std::sin(2 * std::numbers::pi * resonance_Hz * t_s);
      }
      struck_s += (1 + slip * gaussian(generator)) / repeated_Hz;
    }
    return x;
  }
};

}  // namespace rvbench::test
