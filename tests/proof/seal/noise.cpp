#include "tests/proof/seal/noise.hpp"

#include <complex>

namespace seal {
namespace {

constexpr Eigen::Index taps = 500;
constexpr double memory = 80;  // taps

// (1 − z⁻¹)^(−slope/2), faded out: white below where it has forgotten.
// Source  Kasdin, Proc. IEEE 83(5), 802-827 (1995), eq. 104
Eigen::VectorXd fractional_filter(double slope) {
  Eigen::VectorXd h(taps);
  h[0] = 1;
  for (Eigen::Index k = 1; k < taps; ++k) {
    h[k] = h[k - 1] * (slope / 2 + static_cast<double>(k) - 1) / static_cast<double>(k);
  }
  for (Eigen::Index k = 0; k < taps; ++k) h[k] *= std::exp(-static_cast<double>(k) / memory);
  return h / h.norm();
}

}  // namespace

Eigen::VectorXd coloured_noise(Eigen::Index count, double slope, Draw& draw) {
  const Eigen::VectorXd filter = fractional_filter(slope).reverse();
  const Eigen::VectorXd white =
      Eigen::VectorXd::NullaryExpr(count + taps - 1, [&] { return draw.normal(); });
  if (slope == 0) return white.tail(count);
  return Eigen::VectorXd::NullaryExpr(
      count, [&](Eigen::Index i) { return filter.dot(white.segment(i, taps)); });
}

double noise_density(double slope, double frequency_Hz, double rate_Hz) {
  const Eigen::VectorXd filter = fractional_filter(slope);
  std::complex<double> gain = 0;
  for (Eigen::Index k = 0; k < taps; ++k) {
    gain += filter[k] * std::polar(1.0, -2 * std::numbers::pi * frequency_Hz / rate_Hz *
                                            static_cast<double>(k));
  }
  return 2 / rate_Hz * std::norm(gain);
}

}  // namespace seal
