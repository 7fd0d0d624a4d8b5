#include "analysis/explain/period_lines.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fewest_periods = 4;
constexpr Eigen::Index main_lobe = 2;  // lines, to each side of a Hann window's
constexpr double usable_share = 0.4;   // of the sample rate: what resampling leaves alone

// The strongest of so many noise powers has so many times their mean.
double harmonic(Eigen::Index count) {
  double sum = 0;
  for (Eigen::Index i = 1; i <= count; ++i) sum += 1 / static_cast<double>(i);
  return sum;
}

}  // namespace

std::optional<PeriodLines> period_lines(const Channel& signal, const ShaftAngle& angle,
                                        double period_turns) {
  const double periods =
      angle.whole_periods(signal.samples.size(), signal.rate_Hz, signal.start_s, period_turns);
  if (periods < fewest_periods) return std::nullopt;
  const double speed_Hz = angle.mean_speed_Hz();
  const Eigen::VectorXd x = angle.resample(signal.samples, signal.rate_Hz, signal.start_s,
                                           period_turns, signal.rate_Hz / speed_Hz);
  const double per_turn = static_cast<double>(x.size()) / (periods * period_turns);
  const auto apart = static_cast<Eigen::Index>(periods);
  const LineFloor lines = line_floor(amplitude_spectrum(x, per_turn, Window::hann), apart);
  const auto orders =
      static_cast<Eigen::Index>(usable_share * signal.rate_Hz / speed_Hz * period_turns);
  PeriodLines result;
  result.mean = x.mean();
  result.periods = static_cast<double>(apart);
  result.amplitude = result.noise = Eigen::VectorXd::Zero(orders + 1);
  result.between = result.between_noise = Eigen::VectorXd::Zero(orders);
  for (Eigen::Index k = 0; k <= orders; ++k) {
    const Eigen::Index on = k * apart;
    if (k > 0) {
      result.amplitude[k] = std::sqrt(lines.power[on]);
      result.noise[k] = std::sqrt(lines.floor[on]);
    }
    if (k < orders) {
      const auto free = lines.power.segment(on + main_lobe, apart - 2 * main_lobe + 1);
      result.between[k] = std::sqrt(free.maxCoeff());
      result.between_noise[k] = std::sqrt(lines.floor[on + apart / 2] * harmonic(free.size()));
    }
  }
  return result;
}

namespace {

// Complex amplitude 0-to-peak at the first sample, under a Hann window.
std::complex<double> amplitude_at(const Channel& signal, double frequency_Hz) {
  const auto n = signal.samples.size();
  const double mean = signal.samples.mean();
  std::complex<double> sum = 0;
  double weights = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double weight = 1 - std::cos(units::two_pi * place);
    const double turns = frequency_Hz * static_cast<double>(i) / signal.rate_Hz;
    sum += weight * (signal.samples[i] - mean) * std::polar(1.0, -units::two_pi * turns);
    weights += weight;
  }
  return 2.0 * sum / weights;
}

}  // namespace

TimedLine line_at(const Channel& signal, double frequency_Hz) {
  const LineFloor lines =
      line_floor(amplitude_spectrum(signal.samples, signal.rate_Hz, Window::hann), 0);
  const auto nearest = std::clamp<Eigen::Index>(
      std::llround(frequency_Hz / signal.rate_Hz * static_cast<double>(signal.samples.size())), 1,
      lines.floor.size() - 1);
  return {std::abs(amplitude_at(signal, frequency_Hz)), std::sqrt(lines.floor[nearest])};
}

void take_out_line(Channel& signal, double frequency_Hz) {
  const std::complex<double> line = amplitude_at(signal, frequency_Hz);
  for (Eigen::Index i = 0; i < signal.samples.size(); ++i) {
    const double turns = frequency_Hz * static_cast<double>(i) / signal.rate_Hz;
    signal.samples[i] -= (line * std::polar(1.0, units::two_pi * turns)).real();
  }
}

}  // namespace rvbench::analysis
