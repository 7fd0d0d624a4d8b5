#include "analysis/compare/channel_levels.hpp"

#include <cmath>
#include <optional>

#include "analysis/compare/block_spectrum.hpp"
#include "analysis/compare/line_level.hpp"
#include "analysis/indicators/signal_levels.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index parts_of_levels = 8;
constexpr Eigen::Index fewest_parts = 3;
constexpr Eigen::Index fewest_samples = 64;  // in a part: 8 would do for a level, not for a peak
constexpr double speed_error = 3e-4;         // relative: what a stated mean speed may be off
constexpr double seen_p = 1e-4;
constexpr double held_band = 0.4;  // of the rate: as over_angle() has it

double dB_of_power(double power) { return power > 0 ? 10 * std::log10(power) : not_known; }

std::vector<double> values_of(const Eigen::Ref<const Eigen::VectorXd>& x) {
  const SignalLevels s = signal_levels(x);
  return {s.rms, s.peak, s.crest_factor, s.kurtosis};
}

void measure_signal(const Eigen::VectorXd& x, std::vector<Level>& levels) {
  const std::vector<double> whole = values_of(x);
  const Eigen::Index size = x.size() / parts_of_levels;
  const Eigen::Index parts = size < fewest_samples ? 0 : parts_of_levels;
  for (std::size_t q = 0; q < whole.size(); ++q) {
    levels[q].whole_dB = 2 * dB_of_power(whole[q]);
    levels[q].parts_dB.resize(parts);
  }
  for (Eigen::Index part = 0; part < parts; ++part) {
    const std::vector<double> values = values_of(x.segment(part * size, size));
    for (std::size_t q = 0; q < whole.size(); ++q) {
      levels[q].parts_dB[part] = 2 * dB_of_power(values[q]);
    }
  }
}

// The lines of one channel over the shaft's angle.
struct LinesOf {
  const OverAngle& even;
  const std::vector<Quantity>& quantities;
  double highest_order;
  double order_error;  // relative
  int block;
  double period_turns;

  double within(const Quantity& q) const { return (q.stray + order_error) * q.order; }
  bool is_held(const Quantity& q) const {
    return q.is_line() && q.order + within(q) < highest_order;
  }
};

void measure_whole(const LinesOf& of, const Spectrum& spectrum, std::vector<Level>& levels) {
  const auto locked = static_cast<Eigen::Index>(std::lround(of.block / of.period_turns));
  const LineFloor floor = line_floor(spectrum, of.period_turns > 1 ? locked : 0);
  const double blocks =
      std::floor(double(of.even.samples.size()) / of.even.samples_per_turn / of.block);
  for (std::size_t i = 0; i < of.quantities.size(); ++i) {
    const Quantity& q = of.quantities[i];
    if (!of.is_held(q)) continue;
    const auto level = line_level(spectrum, floor, blocks, q.order, of.within(q));
    if (!level) continue;
    levels[i].whole_dB = dB_of_power(level->power);
    levels[i].above_floor_dB = dB_of_power(level->above_floor);
    levels[i].seen = level->p_value <= seen_p;
  }
}

// What a part's spectrum says of a line.
double part_dB(const LinesOf& of, const Spectrum& spectrum, const LineFloor* floor,
               const Quantity& q) {
  if (floor == nullptr) {
    const auto power = single_line_power(spectrum, q.order, of.within(q));
    return power ? dB_of_power(*power) : not_known;
  }
  const auto level = line_level(spectrum, *floor, 1, q.order, of.within(q));
  return level ? dB_of_power(level->power) : not_known;
}

// A period without a window parts all lines that repeat with it; other lines need blocks.
void measure_parts(const LinesOf& of, bool locked, std::vector<Level>& levels) {
  const double turns = locked ? of.period_turns : of.block;
  const auto size = static_cast<Eigen::Index>(std::lround(turns * of.even.samples_per_turn));
  const Eigen::Index parts = of.even.samples.size() / size;
  if (parts < fewest_parts) return;
  for (Eigen::Index part = 0; part < parts; ++part) {
    const Spectrum spectrum =
        amplitude_spectrum(of.even.samples.segment(part * size, size), of.even.samples_per_turn,
                           locked ? Window::rectangular : Window::hann);
    std::optional<LineFloor> floor;
    if (!locked) floor = line_floor(spectrum, 0);
    for (std::size_t i = 0; i < of.quantities.size(); ++i) {
      const Quantity& q = of.quantities[i];
      const bool is_of_period = of.period_turns > 1 && q.stray == 0;
      if (!of.is_held(q) || is_of_period != locked) continue;
      levels[i].parts_dB.conservativeResize(parts);
      levels[i].parts_dB[part] = part_dB(of, spectrum, floor ? &*floor : nullptr, q);
    }
  }
}

void drop_unknown_parts(std::vector<Level>& levels) {
  for (Level& level : levels) {
    if (!level.parts_dB.allFinite()) level.parts_dB.resize(0);
  }
}

}  // namespace

ChannelLevels measure_channel(const Channel& x, const ShaftAngle& angle,
                              const Kinematics& kinematics,
                              const std::vector<Quantity>& quantities) {
  ChannelLevels measured{x.info, x.rate_Hz, double(x.samples.size()) / x.rate_Hz, {}};
  measured.levels.resize(quantities.size());
  measure_signal(x.samples, measured.levels);
  const OverAngle even = over_periods(x, angle, kinematics);
  const int block = block_turns(kinematics);
  const Spectrum spectrum = block_spectrum(even, angle, block);
  if (spectrum.amplitude.size() > 0) {
    const LinesOf of{even,
                     quantities,
                     held_band * x.rate_Hz / angle.mean_speed_Hz(),
                     angle.is_measured() ? 0 : speed_error,
                     block,
                     whole_period(kinematics)};
    measure_whole(of, spectrum, measured.levels);
    measure_parts(of, false, measured.levels);
    if (of.period_turns > 1) measure_parts(of, true, measured.levels);
  }
  drop_unknown_parts(measured.levels);
  return measured;
}

}  // namespace rvbench::analysis
