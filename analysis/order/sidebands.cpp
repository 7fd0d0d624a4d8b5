#include "analysis/order/sidebands.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "analysis/diagnosis.hpp"
#include "analysis/fft.hpp"
#include "analysis/line_floor.hpp"
#include "analysis/order/standing_lines.hpp"
#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index fewest_lines = 64;  // within the band
constexpr Eigen::Index carrier_near = 3;   // lines that a carrier may be off
constexpr Eigen::Index trimmed = 16;       // samples of the demodulated carrier, at both ends
constexpr double same_spacing = 1;         // line
constexpr double off_by_rounding = 1e-9;   // depth or index
constexpr int most_multiples = 12;
constexpr double faded = 1.0 / 3;  // of the mean modulus

// A carrier turned back to order 0.
struct Demodulated {
  double step_turns = 0;
  double amplitude = 0;
  double turning = 0;  // what was left of its order
  bool first_order = false;
  Eigen::VectorXd am;  // over the amplitude
  Eigen::VectorXd pm_rad;
  Eigen::VectorXcd steady;  // the carrier, turning no more
};

// Samples of lines centre − reach .. centre + reach as if centre were line 0; the outer quarters
// fade out. Complex as two real series, one sample per line.
Eigen::VectorXcd around(const Eigen::VectorXcd& lines, Eigen::Index centre, Eigen::Index reach,
                        double scale) {
  const Eigen::Index n = 2 * reach + 1;
  Eigen::VectorXcd real(reach + 1), imaginary(reach + 1);
  for (Eigen::Index j = 0; j <= reach; ++j) {
    const double into = 4.0 * static_cast<double>(j) / static_cast<double>(reach) - 3;
    const double fade = into <= 0 ? 1 : 0.5 + 0.5 * std::cos(std::numbers::pi * into);
    const std::complex<double> up = lines[centre + j], down = std::conj(lines[centre - j]);
    real[j] = 0.5 * scale * fade * (up + down);
    imaginary[j] = std::complex<double>(0, -0.5) * scale * fade * (up - down);
  }
  Eigen::VectorXcd z(n);
  z.real() = inverse_fft(std::move(real), n) * static_cast<double>(n);
  z.imag() = inverse_fft(std::move(imaginary), n) * static_cast<double>(n);
  return z;
}

// Takes the straight line out of y that fits it best. @return its rise per sample
double level_out(Eigen::VectorXd& y) {
  const Eigen::Index n = y.size();
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(n, -0.5, 0.5) * static_cast<double>(n - 1);
  y.array() -= y.mean();
  const double rise = (t * y.array()).sum() / t.square().sum();
  y.array() -= rise * t;
  return rise;
}

// Σ w·y·exp(−i·2π·spacing·turns) / Σ w under a Hann window: half of a swing, at any spacing.
std::complex<double> line_at(const Eigen::VectorXcd& y, double cycles_per_sample) {
  std::complex<double> sum = 0;
  const auto n = static_cast<double>(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double t = static_cast<double>(i);
    const double window = 1 - std::cos(units::two_pi * t / n);
    sum += window * y[i] * std::polar(1.0, -units::two_pi * cycles_per_sample * t);
  }
  return sum / n;
}

// @param turning  cycles per sample that the carrier is off
Demodulated demodulated(const Eigen::VectorXcd& z, double turning, double turns) {
  const Eigen::Index n = z.size() - 2 * trimmed;
  Demodulated carrier;
  carrier.step_turns = turns / static_cast<double>(z.size());
  carrier.turning = turning / carrier.step_turns;
  carrier.steady.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    carrier.steady[i] = z[trimmed + i] * std::polar(1.0, -units::two_pi * turning * double(i));
  }
  const std::complex<double> mean = line_at(carrier.steady, 0);
  carrier.steady *= std::conj(mean) / std::abs(mean);
  const Eigen::VectorXd modulus = carrier.steady.cwiseAbs();
  carrier.first_order = modulus.minCoeff() < faded * modulus.mean();
  if (carrier.first_order) {
    carrier.amplitude = std::abs(mean);
    carrier.am = carrier.steady.real() / carrier.amplitude;
    carrier.pm_rad = carrier.steady.imag() / carrier.amplitude;
    return carrier;
  }
  carrier.amplitude = modulus.mean();
  carrier.am = modulus / carrier.amplitude;
  carrier.pm_rad.resize(n);
  carrier.pm_rad[0] = std::arg(carrier.steady[0]);
  for (Eigen::Index i = 1; i < n; ++i) {
    carrier.pm_rad[i] =
        carrier.pm_rad[i - 1] + std::arg(carrier.steady[i] * std::conj(carrier.steady[i - 1]));
  }
  carrier.turning += level_out(carrier.pm_rad) / (units::two_pi * carrier.step_turns);
  return carrier;
}

// The spectrum of one of the two swings, and what stands in it.
struct Swing {
  Spectrum spectrum;
  LineFloor floor;
  std::vector<StandingLine> lines;

  Swing(const Eigen::VectorXd& y, double per_turn, double highest_order)
      : spectrum(amplitude_spectrum(y, per_turn, Window::hann)), floor(line_floor(spectrum, 0)) {
    const auto last = static_cast<Eigen::Index>(highest_order / spectrum.resolution);
    searched = std::max(1.0, 2 * static_cast<double>(last));  // lines of both swings
    lines = standing_lines(spectrum, floor, last, significant_p / searched);
  }

  double error_at(double place) const {
    return std::sqrt(floor.floor[static_cast<Eigen::Index>(std::lround(place))] / 2);
  }
  // 1 where nothing stands.
  double p_value_at(double place) const {
    for (const StandingLine& line : lines) {
      if (std::abs(line.place - place) < same_spacing) {
        return std::min(1.0, line.p_value * searched);
      }
    }
    return 1;
  }

  double searched = 1;
};

std::vector<double> places_of(const Swing& am, const Swing& pm) {
  std::vector<StandingLine> all = am.lines;
  all.insert(all.end(), pm.lines.begin(), pm.lines.end());
  std::ranges::sort(all, std::less<>(), &StandingLine::p_value);
  std::vector<double> places;
  for (const StandingLine& line : all) {
    const bool known = std::ranges::any_of(
        places, [&](double place) { return std::abs(place - line.place) < same_spacing; });
    if (!known) places.push_back(line.place);
  }
  return places;
}

void name_multiples(std::vector<Modulation>& modulations, double resolution) {
  std::ranges::sort(modulations, std::less<>(), &Modulation::spacing);
  for (std::size_t i = 0; i < modulations.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double ratio = modulations[i].spacing / modulations[k].spacing;
      const double off = std::abs(ratio - std::round(ratio)) * modulations[k].spacing;
      if (modulations[k].multiple == 1 && ratio > 1.5 && ratio < most_multiples + 0.5 &&
          off < same_spacing * resolution) {
        modulations[i].multiple = static_cast<int>(std::lround(ratio));
        break;
      }
    }
  }
}

std::vector<Modulation> modulations_of(const Demodulated& carrier, double highest_order) {
  const double per_turn = 1 / carrier.step_turns;
  const Swing am(carrier.am, per_turn, highest_order);
  const Swing pm(carrier.pm_rad, per_turn, highest_order);
  const Eigen::VectorXcd am_swing =
      (carrier.am.array() - carrier.am.mean()).cast<std::complex<double>>();
  const Eigen::VectorXcd pm_swing =
      (carrier.pm_rad.array() - carrier.pm_rad.mean()).cast<std::complex<double>>();
  const auto length = static_cast<double>(am_swing.size());
  std::vector<Modulation> modulations;
  for (const double place : places_of(am, pm)) {
    const double cycles = place / length;
    modulations.push_back({.spacing = place * am.spectrum.resolution,
                           .am_depth = 2 * std::abs(line_at(am_swing, cycles)),
                           .pm_index_rad = 2 * std::abs(line_at(pm_swing, cycles)),
                           .am_error = am.error_at(place),
                           .pm_error_rad = pm.error_at(place),
                           .am_p_value = am.p_value_at(place),
                           .pm_p_value = pm.p_value_at(place),
                           .lower = std::abs(line_at(carrier.steady, -cycles)),
                           .upper = std::abs(line_at(carrier.steady, cycles))});
  }
  std::erase_if(modulations, [](const Modulation& m) {
    return std::hypot(m.am_depth, m.pm_index_rad) < off_by_rounding;
  });
  name_multiples(modulations, am.spectrum.resolution);
  std::ranges::sort(modulations, std::greater<>(),
                    [](const Modulation& m) { return std::hypot(m.am_depth, m.pm_index_rad); });
  return modulations;
}

// The highest line near where the carrier should be; empty if noise reaches as high.
std::optional<Eigen::Index> carrier_line(const LineFloor& floor, double place) {
  const auto near = static_cast<Eigen::Index>(std::lround(place));
  Eigen::Index at = 0;
  floor.power.segment(near - carrier_near, 2 * carrier_near + 1).maxCoeff(&at);
  at += near - carrier_near;
  const double p = line_p_value(floor.power[at] / floor.floor[at], 1, floor.floor_lines[at]);
  if (p * (2 * carrier_near + 1) > significant_p) return std::nullopt;
  return at;
}

}  // namespace

Sidebands sidebands_of(const OverAngle& x, const SidebandSearch& search) {
  constexpr Require require{"sidebands_of"};
  const auto n = static_cast<double>(x.samples.size());
  require(x.samples_per_turn > 0 && n > 0 && x.samples.allFinite(), "needs finite samples");
  const double turns = n / x.samples_per_turn;
  const auto reach = static_cast<Eigen::Index>(std::floor(search.reach_order * turns));
  require(reach > 0 && search.carrier_order > search.reach_order &&
              search.carrier_order + search.reach_order < 0.5 * x.samples_per_turn - 4 / turns,
          "the band must lie within (0, half the samples per turn)");
  require(2 * reach + 1 >= fewest_lines, "the band must hold at least 64 lines");

  const Spectrum spectrum = amplitude_spectrum(x.samples, x.samples_per_turn, Window::hann);
  const LineFloor floor = line_floor(spectrum, 0);
  Sidebands found;
  const auto centre = carrier_line(floor, search.carrier_order * turns);
  if (!centre) return found;
  const Eigen::Index within = std::min(reach, *centre - 1);
  const double off = place_of_tone(spectrum.amplitude, *centre) - static_cast<double>(*centre);
  const Eigen::VectorXd swing = x.samples.array() - x.samples.mean();
  const Eigen::VectorXcd z = around(fft(swing), *centre, within, 2 / n);
  const Demodulated carrier = demodulated(z, off / static_cast<double>(z.size()), turns);
  found.carrier_order = static_cast<double>(*centre) / turns + carrier.turning;
  found.carrier_amplitude = carrier.amplitude;
  found.carrier_over_noise = std::pow(carrier.amplitude, 2) * lines_per_hann_line /
                             floor.floor.segment(*centre - within, 2 * within + 1).sum();
  found.first_order = carrier.first_order;
  found.resolution = 1 / (static_cast<double>(carrier.am.size()) * carrier.step_turns);
  found.modulations = modulations_of(carrier, 0.75 * static_cast<double>(within) / turns);
  return found;
}

}  // namespace rvbench::analysis
