#include "analysis/envelope/whitening.hpp"

#include <cmath>
#include <utility>

#include "analysis/fft.hpp"
#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

void check(const Require& require, const Eigen::Ref<const Eigen::VectorXd>& x) {
  require(x.size() >= 4, "needs at least 4 samples");
  require(x.allFinite(), "sample not finite");
}

// Samples of these lines, but for their mean and for what has no twin at negative frequency.
Eigen::VectorXd without_ends(Eigen::VectorXcd lines, Eigen::Index n) {
  lines[0] = 0;
  if (n % 2 == 0) lines[n / 2] = 0;
  return inverse_fft(std::move(lines), n);
}

}  // namespace

Eigen::VectorXd cepstrum_prewhitened(const Eigen::Ref<const Eigen::VectorXd>& x) {
  check(Require{"cepstrum_prewhitened"}, x);
  Eigen::VectorXcd lines = fft(x);
  const double of_white = std::sqrt(double(x.size()));
  for (std::complex<double>& line : lines) {
    const double size = std::abs(line);
    if (size > 0) line *= of_white / size;
  }
  return without_ends(std::move(lines), x.size());
}

Eigen::VectorXd floor_whitened(const Eigen::Ref<const Eigen::VectorXd>& x) {
  check(Require{"floor_whitened"}, x);
  // A Hann line of white noise of variance 1 has a mean power of 4/N times its bandwidth, 1.5.
  const double of_white = std::sqrt(6 / double(x.size()));
  const LineFloor floor = line_floor(amplitude_spectrum(x, 1, Window::hann), 0);
  const Eigen::VectorXcd lines = fft(x).array() * (of_white / floor.floor.array().sqrt());
  return without_ends(lines, x.size());
}

}  // namespace rvbench::analysis
