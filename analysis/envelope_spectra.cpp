#include "analysis/envelope_spectra.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/fft.hpp"
#include "analysis/hilbert.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fewest_per_turn = 32;  // samples

// Power and floor as far as the envelope reaches, and some lines more for the last floor.
LineFloor floor_up_to(const Spectrum& spectrum, double highest_order, Eigen::Index locked_every) {
  constexpr double beyond = 200;
  const auto lines = std::min(static_cast<double>(spectrum.amplitude.size()),
                              highest_order / spectrum.resolution + beyond);
  return line_floor(
      {spectrum.resolution, spectrum.amplitude.head(static_cast<Eigen::Index>(lines))},
      locked_every);
}

// What repeats itself period by period has every `periods`-th line, and no other.
void take_average_out(Eigen::VectorXcd& lines, Eigen::Index periods) {
  for (Eigen::Index line = 0; line < lines.size(); line += periods) lines[line] = 0;
}

}  // namespace

EnvelopeSpectra envelope_spectra(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                 double start_s, const ShaftAngle& angle, double period_turns) {
  EnvelopeSpectra result;
  const double whole = angle.whole_periods(x.size(), rate_Hz, start_s, period_turns);
  if (whole < 1) return result;
  // Steps fine enough for all the envelope's bandwidth, rate/4 at the most, at whatever rate and
  // speed: what wider ones cannot hold would fold onto the lines that are searched.
  const double least_per_turn = std::max(rate_Hz / 2 / angle.mean_speed_Hz(), fewest_per_turn);
  const Eigen::VectorXd over_angle =
      angle.resample(envelope(x), rate_Hz, start_s, period_turns, least_per_turn);
  if (over_angle.size() < 16) return result;

  result.mean = over_angle.mean();
  result.highest_order = 0.5 * crossing_frequency(x, rate_Hz) / angle.mean_speed_Hz();
  result.periods = whole;
  const auto periods = static_cast<Eigen::Index>(whole);
  const Eigen::Index n = over_angle.size();
  const double per_turn = static_cast<double>(n) / (whole * period_turns);
  Eigen::VectorXcd lines = fft(over_angle.array() - result.mean);
  result.whole = amplitude_spectrum(lines, n, per_turn, Window::hann);
  result.lines = floor_up_to(result.whole, result.highest_order, periods);
  if (periods < 2) {
    result.unlocked = result.lines;
    return result;
  }
  take_average_out(lines, periods);
  result.unlocked = floor_up_to(amplitude_spectrum(std::move(lines), n, per_turn, Window::hann),
                                result.highest_order, periods);
  return result;
}

}  // namespace rvbench::analysis
