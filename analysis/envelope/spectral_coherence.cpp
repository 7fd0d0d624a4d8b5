#include "analysis/envelope/spectral_coherence.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index fewest_lines = 16;
constexpr Eigen::Index of_window = 3;          // first cyclic line that Hann does not reach
constexpr double lines_per_own = 35.0 / 18.0;  // <w⁴>/<w²>²: Hann lines are not independent

Eigen::VectorXcd hann_lines(const Eigen::Ref<const Eigen::VectorXd>& x) {
  const double mean = x.mean();
  const double turn_rad = 2 * std::numbers::pi / double(x.size());
  Eigen::VectorXd weighed(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    weighed[i] = (1 - std::cos(turn_rad * (double(i) + 0.5))) * (x[i] - mean);
  }
  return fft(weighed);
}

// Σ X[k + a]·X*[k] over a band of the lines, for a = 0 .. highest.
Eigen::VectorXcd correlation_above(const Eigen::VectorXcd& lines, Eigen::Index from,
                                   Eigen::Index size, Eigen::Index highest) {
  const Eigen::Index length = next_fast_length(size + highest);
  Eigen::VectorXcd own = Eigen::VectorXcd::Zero(length);
  Eigen::VectorXcd above = Eigen::VectorXcd::Zero(length);
  own.head(size) = lines.segment(from, size);
  above.head(size + highest) = lines.segment(from, size + highest);
  own = complex_fft(std::move(own));
  above = complex_fft(std::move(above));
  return inverse_complex_fft(above.cwiseProduct(own.conjugate())).head(highest + 1);
}

// Strikes without a period are heard in many bands at once, which then are no independent averages.
// How far lines scatter is seen from those that stand out least of the highest tenth.
void measure_tail(TestedSpectrum& tested) {
  constexpr double hann_lines = lines_per_own;  // neighbours are not independent
  constexpr double median_worth = 0.48;         // of independent lines
  std::vector<double> ratios;
  for (Eigen::Index line = tested.first; line <= tested.last; ++line) {
    const double amplitude = tested.spectrum.amplitude[line];
    ratios.push_back(amplitude * amplitude / tested.noise[line]);
  }
  const auto tenth = static_cast<std::ptrdiff_t>(ratios.size() / 10);
  if (tenth < 5) return;
  std::ranges::sort(ratios, std::greater{});
  tested.tail_from = ratios[std::size_t(tenth)];
  tested.tail_scale = (ratios[std::size_t(tenth / 2)] - tested.tail_from) / std::numbers::ln2;
  tested.tail_lines = std::max(1.0, double(tenth) * median_worth / hann_lines);
}

// Mean over these bands, tested against stationary noise and against what is around.
TestedSpectrum mean_coherence(const SpectralCoherence& coherence, Eigen::Index from,
                              Eigen::Index bands) {
  const Eigen::VectorXd mean = coherence.squared.middleRows(from, bands).colwise().mean();
  Spectrum spectrum{coherence.resolution, mean.cwiseMax(0).cwiseSqrt()};
  spectrum.amplitude.head(std::min(of_window, mean.size())).setZero();
  TestedSpectrum tested = tested_against_floor(std::move(spectrum), mean.size() - 1);
  tested.averages = double(bands);
  tested.first = of_window;
  // The floor is the median over that of an exponential; of a mean of several the median is nearer
  // to the mean (Wilson & Hilferty 1931).
  const double median = std::pow(1 - 1 / (9 * tested.averages), 3);
  tested.noise = (tested.noise * (std::numbers::ln2 / median)).cwiseMax(1 / coherence.lines);
  tested.floor_lines *= tested.averages;
  measure_tail(tested);
  return tested;
}

}  // namespace

SpectralCoherence spectral_coherence(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                                     const CoherenceOptions& options) {
  constexpr Require require{"spectral_coherence"};
  require(x.allFinite(), "sample not finite");
  require(options.bands >= 1, "bands must be at least 1");
  require_positive(rate, "spectral_coherence", "rate");
  require_positive(options.highest, "spectral_coherence", "highest");
  const double resolution = rate / double(std::max<Eigen::Index>(x.size(), 1));
  require(options.highest < rate / 2, "highest must be below half the rate");
  const auto highest = static_cast<Eigen::Index>(std::ceil(options.highest / resolution));
  const Eigen::Index size = (x.size() / 2 - 1 - highest) / options.bands;
  require(size >= fewest_lines, std::to_string(size) + " lines in a band, must be at least 16");

  const Eigen::VectorXcd lines = hann_lines(x);
  // Powers are summed up from line 0, so that those of any band are a difference.
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(lines.size() + 1);
  for (Eigen::Index k = 0; k < lines.size(); ++k) sums[k + 1] = sums[k] + std::norm(lines[k]);

  SpectralCoherence result{resolution, resolution, double(size) * resolution,
                           Eigen::MatrixXd(options.bands, highest + 1),
                           double(size) / lines_per_own};
  for (Eigen::Index band = 0; band < options.bands; ++band) {
    const Eigen::Index from = 1 + band * size;
    const Eigen::VectorXcd products = correlation_above(lines, from, size, highest);
    const double own = sums[from + size] - sums[from];
    for (Eigen::Index a = 0; a <= highest; ++a) {
      const double powers = own * (sums[from + a + size] - sums[from + a]);
      result.squared(band, a) = powers > 0 ? std::min(1.0, std::norm(products[a]) / powers) : 0;
    }
  }
  return result;
}

TestedSpectrum enhanced_envelope_spectrum(const SpectralCoherence& coherence) {
  return mean_coherence(coherence, 0, coherence.squared.rows());
}

TestedSpectrum improved_envelope_spectrum(const SpectralCoherence& coherence, double from,
                                          double to) {
  Eigen::Index first = 0, end = 0;
  for (Eigen::Index band = 0; band < coherence.squared.rows(); ++band) {
    const double middle = coherence.first + (double(band) + 0.5) * coherence.width;
    if (middle < from) first = band + 1;
    if (middle < to) end = band + 1;
  }
  constexpr Require require{"improved_envelope_spectrum"};
  require(end > first, "no band has its middle there");
  return mean_coherence(coherence, first, end - first);
}

}  // namespace rvbench::analysis
