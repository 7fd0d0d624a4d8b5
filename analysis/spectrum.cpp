#include "analysis/spectrum.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "analysis/fft.hpp"

namespace rvbench::analysis {
namespace {

void check(const Eigen::Ref<const Eigen::VectorXd>& x, double rate) {
  if (x.size() < 2) {
    throw std::invalid_argument("amplitude_spectrum: N = " + std::to_string(x.size()) +
                                ", at least 2");
  }
  if (!(rate > 0)) {
    throw std::invalid_argument("amplitude_spectrum: rate = " + std::to_string(rate) +
                                ", must be positive");
  }
  if (!x.allFinite()) throw std::invalid_argument("amplitude_spectrum: sample not finite");
}

// The periodic Hann window scaled to mean 1, so that the calibration is that of no window at all.
Eigen::ArrayXd hann(Eigen::Index n) {
  const double step_rad = 2 * std::numbers::pi / static_cast<double>(n);
  return 1 - (Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1)) * step_rad).cos();
}

}  // namespace

Spectrum amplitude_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                            Window window) {
  check(x, rate);
  const Eigen::Index n = x.size();
  const double mean = x.mean();
  Eigen::VectorXd swing = x.array() - mean;
  if (window == Window::hann) swing.array() *= hann(n);

  Spectrum spectrum{.resolution = rate / static_cast<double>(n), .amplitude = {}};
  spectrum.amplitude = fft(swing).cwiseAbs() * (2 / static_cast<double>(n));
  spectrum.amplitude[0] = std::abs(mean);
  // Half the sample rate has no negative twin that would carry the other half of its amplitude.
  if (n % 2 == 0) spectrum.amplitude[n / 2] /= 2;
  return spectrum;
}

}  // namespace rvbench::analysis
