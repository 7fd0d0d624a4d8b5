#include "analysis/frf/find_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/frf/hit_windows.hpp"
#include "analysis/frf/motion.hpp"
#include "analysis/frf/peak_fitter.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {

namespace {

constexpr double largest_damping = 0.2;
constexpr double least_explained = 0.5;

std::vector<FrequencyResponse> as_mobilities(const std::vector<FrequencyResponse>& responses) {
  std::vector<FrequencyResponse> mobilities;
  for (const FrequencyResponse& frf : responses) {
    mobilities.push_back(as_motion(frf, Motion::velocity).value_or(frf));
  }
  return mobilities;
}

FoundMode mode_of(const PeakFit& found, double p_value) {
  FoundMode mode;
  const double error_rad_s = found.fit.errors_rad_s[found.pole];
  mode.frequency_Hz = found.frequency_Hz();
  mode.damping_ratio = found.damping_ratio();
  mode.frequency_error_Hz = error_rad_s / units::two_pi;
  mode.damping_error = mode.frequency_error_Hz / mode.frequency_Hz;
  mode.p_value = p_value;
  mode.stands_out_dB =
      20 * std::log10(found.fit.heights[found.pole] / found.fit.backgrounds[found.pole]);
  mode.residues = found.fit.residues.row(found.pole).transpose();
  return mode;
}

// Fits of narrower and wider bands must agree.
void doubt_band(FoundMode& mode, const PeakFitter& fitter, const PeakFit& found,
                const IndicatorPeak& peak) {
  const double allowed_Hz =
      std::max(found.damping_ratio() * found.frequency_Hz(), 0.5 * fitter.step_Hz());
  for (const double scale : {0.7, 1.4}) {
    const char* width = scale < 1 ? "narrower" : "wider";
    const double half = std::max(scale * double(found.to - found.from) / 2, 4.0);
    const auto other = fitter.fit_at(peak, Eigen::Index(std::lround(half)));
    if (!other) {
      mode.doubts.push_back(fmt::format("no fit in a {} band", width));
      continue;
    }
    const double shift_Hz = std::abs(other->frequency_Hz() - found.frequency_Hz());
    if (shift_Hz < allowed_Hz) continue;
    mode.doubts.push_back(fmt::format("a {} band puts it {:.3g} Hz elsewhere", width, shift_Hz));
  }
}

void doubt_fit(FoundMode& mode, double explained, double span_Hz) {
  if (explained < least_explained) {
    mode.doubts.push_back(fmt::format("the fit explains {:.0f} %", 100 * explained));
  }
  if (mode.stands_out_dB < 0) {
    mode.doubts.push_back(fmt::format("{:.1f} dB below all else at its peak", -mode.stands_out_dB));
  }
  if (mode.frequency_Hz > span_Hz) {
    mode.doubts.push_back(fmt::format("above the span of {:.6g} Hz", span_Hz));
  }
}

// The damped frequency stays, the undamped one follows the damping.
void take_out_window(FoundMode& mode, double decay_s) {
  const double seen = mode.damping_ratio;
  mode.damping_ratio = damping_without_window(seen, mode.frequency_Hz, decay_s);
  mode.frequency_Hz *= std::sqrt((1 - seen * seen) / (1 - mode.damping_ratio * mode.damping_ratio));
  if (mode.damping_ratio < 2 * mode.damping_error) {
    mode.doubts.push_back("its damping is all of the window's");
  }
}

void doubt_damping(FoundMode& mode) {
  if (mode.damping_ratio > 0 && mode.damping_error > mode.damping_ratio / 3) {
    mode.doubts.push_back(
        fmt::format("damping of {:.2g} known to {:.2g}", mode.damping_ratio, mode.damping_error));
  }
  if (mode.damping_ratio > largest_damping) {
    mode.doubts.push_back(fmt::format("damping of {:.2g}", mode.damping_ratio));
  }
}

std::optional<FoundMode> mode_at(const IndicatorPeak& peak, const PeakFitter& fitter,
                                 const ModeSearch& search) {
  const auto found = fitter.settled_fit(peak);
  if (!found || !(found->damping_ratio() > 0)) return std::nullopt;
  const double half_width_Hz = found->damping_ratio() * found->frequency_Hz();
  const double away_Hz = std::abs(found->peak_Hz() - fitter.frequency_Hz(peak.line));
  if (away_Hz > std::max(fitter.step_Hz(), half_width_Hz)) return std::nullopt;
  const double p_value = std::min(1.0, fitter.p_value(*found) * double(fitter.peaks().size()));
  if (p_value > search.false_alarms) return std::nullopt;
  FoundMode mode = mode_of(*found, p_value);
  doubt_fit(mode, fitter.explained(*found), search.span_Hz);
  doubt_band(mode, fitter, *found, peak);
  if (std::isfinite(search.decay_s)) take_out_window(mode, search.decay_s);
  doubt_damping(mode);
  return mode;
}

bool is_same(const FoundMode& a, const FoundMode& b) {
  const double alike =
      std::norm(a.residues.dot(b.residues)) / (a.residues.squaredNorm() * b.residues.squaredNorm());
  const double half_width_Hz = std::abs(a.damping_ratio) * a.frequency_Hz;
  return alike > 0.9 && b.frequency_Hz - a.frequency_Hz < 0.1 * half_width_Hz;
}

// Two peaks that were led to one pole are one mode.
std::vector<FoundMode> without_doubles(std::vector<FoundMode> modes) {
  std::ranges::sort(modes, {}, &FoundMode::frequency_Hz);
  std::vector<FoundMode> kept;
  for (FoundMode& mode : modes) {
    if (kept.empty() || !is_same(kept.back(), mode)) {
      kept.push_back(std::move(mode));
    } else if (mode.p_value < kept.back().p_value) {
      kept.back() = std::move(mode);
    }
  }
  return kept;
}

}  // namespace

std::vector<FoundMode> find_modes(const std::vector<FrequencyResponse>& responses,
                                  const ModeSearch& search) {
  constexpr Require require{"find_modes"};
  require(!responses.empty(), "no response");
  require(search.from_Hz < search.to_Hz, "from_Hz must be below to_Hz");
  require(search.decay_s > 0, "decay_s must be above 0");
  require(search.least_prominence_dB > 0 && search.false_alarms > 0, "thresholds must be above 0");
  require(responses.front().step_Hz > 0, "step_Hz must be above 0");
  const PeakFitter fitter(as_mobilities(responses), search.least_prominence_dB);
  const std::vector<IndicatorPeak>& peaks = fitter.peaks();
  std::vector<std::optional<FoundMode>> found(peaks.size());
  parallel_for(peaks.size(), [&](std::size_t i) {
    const double f_Hz = fitter.frequency_Hz(peaks[i].line);
    if (f_Hz >= search.from_Hz && f_Hz <= search.to_Hz) {
      found[i] = mode_at(peaks[i], fitter, search);
    }
  });
  std::vector<FoundMode> modes;
  for (auto& mode : found) {
    if (mode) modes.push_back(std::move(*mode));
  }
  return without_doubles(std::move(modes));
}

}  // namespace rvbench::analysis
