#include "analysis/examples/signals.hpp"

#include <cmath>
#include <random>

#include "hal/types/units.hpp"

namespace rvbench::analysis::examples {

Eigen::ArrayXd times_s(Eigen::Index n, double rate_Hz) {
  return Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1)) / rate_Hz;
}

Eigen::VectorXd wave(const Eigen::ArrayXd& cycles) { return (units::two_pi * cycles).cos(); }

Eigen::VectorXd noise(Eigen::Index n, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian;
  return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index) { return gaussian(generator); });
}

Eigen::VectorXd struck(const Strikes& s, Eigen::Index n, unsigned seed) {
  const double end_s = static_cast<double>(n) / s.rate_Hz;
  const Eigen::VectorXd slips = noise(static_cast<Eigen::Index>(end_s / s.every_s) + 2, seed);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < slips.size(); ++k) {
    const double at_s = (static_cast<double>(k) + 0.5 + s.slip * slips[k]) * s.every_s;
    const auto first = static_cast<Eigen::Index>(std::ceil(at_s * s.rate_Hz));
    for (Eigen::Index i = first; i < n; ++i) {
      const double since_s = static_cast<double>(i) / s.rate_Hz - at_s;
      if (since_s > 12 * s.decay_s) break;
      x[i] += std::exp(-since_s / s.decay_s) * std::sin(units::two_pi * s.resonance_Hz * since_s);
    }
  }
  return x;
}

double rms(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

}  // namespace rvbench::analysis::examples
