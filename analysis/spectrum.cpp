#include "analysis/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {
namespace {

void check(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < 2) {
    throw std::invalid_argument("amplitude_spectrum: N = " + std::to_string(x.size()) +
                                ", at least 2");
  }
  if (!x.allFinite()) throw std::invalid_argument("amplitude_spectrum: sample not finite");
}

// The periodic Hann window 1 − cos, scaled to mean 1 so that the calibration is that of no window
// at all: over frequency it takes half of each neighbour from a line.
Eigen::VectorXcd under_hann(const Eigen::VectorXcd& half, Eigen::Index n) {
  const Eigen::Index last = half.size() - 1;
  Eigen::VectorXcd padded(half.size() + 2);  // with one line of negative frequency at either end
  padded << std::conj(half[1]), half, std::conj(half[n % 2 == 0 ? last - 1 : last]);
  return half - 0.5 * (padded.head(half.size()) + padded.tail(half.size()));
}

}  // namespace

Spectrum amplitude_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                            Window window) {
  check(x);
  const double mean = x.mean();
  const Eigen::VectorXd swing = x.array() - mean;
  Eigen::VectorXcd lines = fft(swing);
  lines[0] = mean * static_cast<double>(x.size());
  return amplitude_spectrum(std::move(lines), x.size(), rate, window);
}

Spectrum amplitude_spectrum(Eigen::VectorXcd lines, Eigen::Index n, double rate, Window window) {
  constexpr Require require{"amplitude_spectrum"};
  require(n >= 2 && lines.size() == n / 2 + 1, "lines must be those of n >= 2 samples");
  require_positive(rate, "amplitude_spectrum", "rate");
  const double sum = std::abs(lines[0]);
  lines[0] = 0;
  if (window == Window::hann) lines = under_hann(lines, n);

  const auto samples = static_cast<double>(n);
  Spectrum spectrum{.resolution = rate / samples, .amplitude = {}};
  spectrum.amplitude = lines.cwiseAbs2().cwiseSqrt() * (2 / samples);
  spectrum.amplitude[0] = sum / samples;
  // Half the sample rate has no negative twin that would carry the other half of its amplitude.
  if (n % 2 == 0) spectrum.amplitude[n / 2] /= 2;
  return spectrum;
}

Eigen::VectorXcd lines_under_hann(const Eigen::VectorXcd& lines, Eigen::Index count) {
  Eigen::VectorXcd windowed = Eigen::VectorXcd::Zero(count);
  const Eigen::Index inner = std::min(count, lines.size() - 1) - 1;
  windowed.segment(1, inner) =
      lines.segment(1, inner) - 0.5 * (lines.segment(0, inner) + lines.segment(2, inner));
  return windowed;
}

double place_of_tone(const Eigen::VectorXd& amplitude, Eigen::Index line) {
  const bool above = amplitude[line + 1] > amplitude[line - 1];
  const double ratio = amplitude[above ? line + 1 : line - 1] / amplitude[line];
  const double away = (2 * ratio - 1) / (ratio + 1);
  return static_cast<double>(line) + (above ? away : -away);
}

}  // namespace rvbench::analysis
