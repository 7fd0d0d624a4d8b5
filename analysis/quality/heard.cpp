#include "analysis/quality/heard.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/fft.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double lowest_Hz = 20;    // below: 1/f noise of amplifiers, and what AC coupling leaves
constexpr double highest = 0.4;     // of the sample rate: below the anti-alias filter's slope
constexpr Eigen::Index few_lines = 8;  // an octave of fewer has no middle worth the name

// Mean square of the signal within some lines.
double power_of(const Eigen::Ref<const Eigen::VectorXd>& amplitude) {
  return amplitude.squaredNorm() / 2 / lines_per_hann_line;
}

}  // namespace

Heard heard(const Channel& channel) {
  const auto fast = channel.samples.head(fast_length_within(channel.samples.size()));
  Heard h{.unit = channel.info.unit,
          .spectrum = amplitude_spectrum(fast, channel.rate_Hz, Window::hann)};
  const Eigen::VectorXd& amplitude = h.spectrum.amplitude;
  const auto line_of = [&](double frequency_Hz) {
    return std::min(static_cast<Eigen::Index>(frequency_Hz / h.spectrum.resolution),
                    amplitude.size());
  };
  const Eigen::Index end = line_of(highest * channel.rate_Hz);
  double noise = 0;
  double lowest = std::numeric_limits<double>::infinity();
  double loudest = 0;
  for (Eigen::Index from = line_of(lowest_Hz) + 1, to = 0; from < end; from = to) {
    to = end < 4 * from ? end : 2 * from;  // the last octave takes what is left
    if (to - from < few_lines) continue;
    const auto octave = amplitude.segment(from, to - from);
    h.rms += power_of(octave);
    // Noise power is exponentially distributed: its mean is the median over ln 2.
    const double middle = median({octave.data(), octave.data() + octave.size()});
    const double density = middle * middle / std::numbers::ln2;
    noise += density * static_cast<double>(octave.size()) / 2 / lines_per_hann_line;
    lowest = std::min(lowest, density);
    loudest = std::max(loudest, density);
  }
  h.rms = std::sqrt(h.rms);
  h.noise = std::sqrt(noise);
  h.evenness = loudest > 0 ? lowest / loudest : 0;
  return h;
}

double rms_at(const Spectrum& spectrum, double frequency_Hz) {
  const auto line = static_cast<Eigen::Index>(std::lround(frequency_Hz / spectrum.resolution));
  if (line < 2 || line + 2 >= spectrum.amplitude.size()) return 0;
  return std::sqrt(power_of(spectrum.amplitude.segment(line - 2, 5)));
}

}  // namespace rvbench::analysis
