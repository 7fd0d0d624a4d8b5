#include "analysis/frf/peak_fitter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/frf/mode_indicator.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {

namespace {

constexpr Eigen::Index least_half_band = 5;   // lines to each side
constexpr Eigen::Index most_half_band = 200;  // more tell nothing new
constexpr double half_band_widths = 1.5;      // in half-power bandwidths
constexpr int most_poles = 3;

Eigen::Index half_band(double bandwidth_lines) {
  const double half = half_band_widths * bandwidth_lines;
  return Eigen::Index(
      std::lround(std::clamp(half, double(least_half_band), double(most_half_band))));
}

// Of the second of two peaks at one line: the pole beside it that is the smaller one there.
Eigen::Index weaker_neighbour(const PoleFit& fit, Eigen::Index nearest, double peak_rad_s) {
  Eigen::Index second = nearest;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < fit.poles_rad_s.size(); ++i) {
    const double away = std::abs(fit.poles_rad_s[i].imag() - peak_rad_s);
    if (i == nearest || away > least) continue;
    least = away;
    second = i;
  }
  return fit.heights[second] < fit.heights[nearest] ? second : nearest;
}

}  // namespace

double PeakFit::frequency_Hz() const { return std::abs(fit.poles_rad_s[pole]) / units::two_pi; }

double PeakFit::peak_Hz() const { return fit.poles_rad_s[pole].imag() / units::two_pi; }

double PeakFit::damping_ratio() const {
  return -fit.poles_rad_s[pole].real() / std::abs(fit.poles_rad_s[pole]);
}

PeakFitter::PeakFitter(const std::vector<FrequencyResponse>& responses, double least_rise_dB)
    : first_Hz_(responses.front().first_Hz),
      step_Hz_(responses.front().step_Hz),
      peaks_(indicator_peaks(mode_indicator(responses), least_rise_dB)) {
  values_.resize(responses.front().values.size(), Eigen::Index(responses.size()));
  for (std::size_t i = 0; i < responses.size(); ++i) {
    values_.col(Eigen::Index(i)) = responses[i].values;
  }
  while (first_known_ < values_.rows() && !values_.row(first_known_).allFinite()) ++first_known_;
}

std::optional<PeakFit> PeakFitter::settled_fit(const IndicatorPeak& peak) const {
  Eigen::Index half = half_band(double(peak.width));
  std::optional<PeakFit> found = fit_at(peak, half);
  for (int i = 0; i < 3 && found && found->damping_ratio() > 0; ++i) {
    const Eigen::Index better =
        half_band(2 * found->damping_ratio() * found->frequency_Hz() / step_Hz_);
    if (better == half) break;
    half = better;
    found = fit_at(peak, half);
  }
  return found;
}

std::optional<PeakFit> PeakFitter::fit_at(const IndicatorPeak& peak, Eigen::Index half) const {
  PeakFit found;
  found.from = std::max(peak.line - half, first_known_);
  found.to = std::min(peak.line + half, values_.rows() - 1);
  const auto beside = std::ranges::count_if(peaks_, [&](const IndicatorPeak& other) {
    return other.line >= found.from && other.line <= found.to;
  });
  found.poles = std::min(int(beside), most_poles);
  auto fit = fit_band(found.from, found.to, found.poles);
  if (!fit) return std::nullopt;
  found.fit = std::move(*fit);
  const double peak_rad_s = units::two_pi * frequency_Hz(peak.line);
  (found.fit.poles_rad_s.imag().array() - peak_rad_s).abs().minCoeff(&found.pole);
  if (peak.curve > 0) found.pole = weaker_neighbour(found.fit, found.pole, peak_rad_s);
  return found;
}

double PeakFitter::p_value(const PeakFit& found) const {
  const auto without = fit_band(found.from, found.to, found.poles - 1);
  if (!without) return 1;
  const double noise = found.fit.left_over / found.fit.freedom;
  if (!(noise > 0)) return 0;
  const double better = without->left_over - found.fit.left_over;
  return line_p_value(better / noise, double(values_.cols() + 1), found.fit.freedom);
}

double PeakFitter::explained(const PeakFit& found) const {
  const Eigen::Index lines = found.to - found.from + 1;
  return 1 - found.fit.left_over / values_.middleRows(found.from, lines).squaredNorm();
}

std::optional<PoleFit> PeakFitter::fit_band(Eigen::Index from, Eigen::Index to, int poles) const {
  if (to - from + 1 < poles + 5) return std::nullopt;
  const FitBand band{frequency_Hz(from), step_Hz_, values_.middleRows(from, to - from + 1)};
  if (!band.values.allFinite()) return std::nullopt;
  return fit_poles(band, poles);
}

}  // namespace rvbench::analysis
