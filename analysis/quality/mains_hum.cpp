#include "analysis/quality/mains_hum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double tolerance_Hz = 0.2;  // of the grid
constexpr double wander_Hz = 0.01;    // of the grid, within a record
constexpr double coarsest_Hz = 0.1;   // resolution that parts the grid from order 5 at 605 rpm
constexpr double around_Hz = 3;       // where noise is read, on either side
constexpr double strong = 100;        // times the noise power
constexpr double alone = 10;          // times as strong as elsewhere
constexpr double matters = 0.1;       // of the rms
constexpr std::size_t fewest_other_points = 2;
constexpr double lobe_lines = 2;  // half the main lobe of the Hann window

// Mean power of noise lines around a line.
double noise_around(const Spectrum& spectrum, Eigen::Index line) {
  const auto reach = static_cast<Eigen::Index>(around_Hz / spectrum.resolution);
  const Eigen::Index from = std::max<Eigen::Index>(line - reach, 1);
  const Eigen::Index to = std::min(line + reach + 1, spectrum.amplitude.size());
  const double* a = spectrum.amplitude.data();
  const double middle = median({a + from, a + to});
  return middle * middle / std::numbers::ln2;
}

// Frequency of the strongest line within a band if it stands out of its noise.
std::optional<double> line_within(const Spectrum& spectrum, double middle_Hz, double within_Hz) {
  const Eigen::VectorXd& amplitude = spectrum.amplitude;
  const auto from =
      static_cast<Eigen::Index>(std::ceil((middle_Hz - within_Hz) / spectrum.resolution));
  const auto to = static_cast<Eigen::Index>((middle_Hz + within_Hz) / spectrum.resolution);
  if (from < 2 || to + 2 >= amplitude.size() || to < from) return std::nullopt;
  Eigen::Index at = 0;
  const double top = amplitude.segment(from, to - from + 1).maxCoeff(&at);
  at += from;
  if (top < amplitude[at - 1] || top < amplitude[at + 1]) return std::nullopt;
  if (top * top < strong * noise_around(spectrum, at)) return std::nullopt;
  return place_of_tone(amplitude, at) * spectrum.resolution;
}

double rms_of(const Spectrum& spectrum, double grid_Hz, const std::vector<int>& harmonics) {
  double power = 0;
  for (const int h : harmonics) power += std::pow(rms_at(spectrum, h * grid_Hz), 2);
  return std::sqrt(power);
}

// Hum over all else that the channel hears.
double contrast(const Heard& channel, double hum) {
  return hum / std::sqrt(std::max(channel.rms * channel.rms - hum * hum, 1e-12 * hum * hum));
}

// Lines of the grid in one channel, whoever else hears them.
std::optional<MainsHum> lines_of_grid(const Heard& channel, double nominal_Hz,
                                      const std::function<bool(double, double)>& is_of_machine) {
  const Spectrum& spectrum = channel.spectrum;
  const double resolution = spectrum.resolution;
  const std::optional<double> first = line_within(spectrum, nominal_Hz, tolerance_Hz);
  if (!first || is_of_machine(*first, lobe_lines * resolution)) return std::nullopt;
  MainsHum hum{.grid_Hz = *first, .harmonics = {1}};
  for (const int h : {3, 5, 7}) {
    // A tone is placed to a tenth of a line or so, and h times that is how far its harmonic may be.
    const double within_Hz = (0.5 + 0.15 * h) * resolution + wander_Hz * h;
    const std::optional<double> line = line_within(spectrum, h * *first, within_Hz);
    if (line && !is_of_machine(*line, lobe_lines * resolution)) hum.harmonics.push_back(h);
  }
  if (hum.harmonics.size() < 2) return std::nullopt;
  std::vector<int> even{2, 4, 6};
  std::erase_if(even,
                [&](int h) { return is_of_machine(h * *first, 2 * lobe_lines * resolution); });
  if (rms_of(spectrum, *first, even) > rms_of(spectrum, *first, {3, 5, 7})) return std::nullopt;
  hum.rms = rms_of(spectrum, *first, hum.harmonics);
  hum.share = hum.rms / channel.rms;
  if (hum.share < matters) return std::nullopt;
  return hum;
}

}  // namespace

std::optional<MainsHum> find_mains_hum(const std::vector<Heard>& channels, std::size_t one,
                                       const std::function<bool(double, double)>& is_of_machine) {
  const Heard& channel = channels.at(one);
  if (channel.spectrum.resolution > coarsest_Hz) return std::nullopt;
  for (const double nominal_Hz : {50.0, 60.0}) {
    const auto hum = lines_of_grid(channel, nominal_Hz, is_of_machine);
    if (!hum) continue;
    std::vector<double> sizes;
    std::vector<double> contrasts;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (i == one || channels[i].unit != channel.unit) continue;
      sizes.push_back(rms_of(channels[i].spectrum, hum->grid_Hz, hum->harmonics));
      contrasts.push_back(contrast(channels[i], sizes.back()));
    }
    if (sizes.size() < fewest_other_points) return std::nullopt;
    if (hum->rms > alone * median(sizes) &&
        contrast(channel, hum->rms) > alone * median(contrasts)) {
      return hum;
    }
  }
  return std::nullopt;
}

}  // namespace rvbench::analysis
