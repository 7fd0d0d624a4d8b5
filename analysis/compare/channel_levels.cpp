#include "analysis/compare/channel_levels.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/compare/block_floor.hpp"
#include "analysis/compare/block_spectrum.hpp"
#include "analysis/compare/line_level.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/order/synchronous_average.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index parts_of_levels = 8;
constexpr Eigen::Index fewest_parts = 3;
constexpr Eigen::Index fewest_samples = 64;  // in a part: 8 would do for a level, not for a peak
constexpr double held_band = 0.4;            // of the rate: as over_angle() has it

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

// Lines of one kind, and the samples over the shaft's angle that they are read from.
struct LinesOf {
  const OverAngle& even;
  const ShaftAngle& angle;
  const Kinematics& kinematics;
  const std::vector<Quantity>& quantities;
  double rate_Hz;
  int block;
  double period_turns;  // 1: the train has none
  bool locked;          // to the period: else those that stray from it, or all where there is none

  // Lines from one that repeats with the train, or that was taken out with it, to the next.
  Eigen::Index every() const {
    return period_turns == 1 ? 0 : static_cast<Eigen::Index>(std::lround(block / period_turns));
  }
  double within(const Quantity& q) const {
    return (q.stray + speed_error(angle.is_measured())) * q.order;
  }
  double top_order() const { return held_band * rate_Hz / angle.mean_speed_Hz(); }
  bool holds(const Quantity& q) const {
    const bool is_of_kind = period_turns == 1 || locked == (q.stray == 0);
    return q.is_line() && is_of_kind && q.order + within(q) < top_order();
  }
};

// Where a line is read: about its order, or where its part was found.
struct Place {
  double order, within;
  double p_value = 0;  // of all lines of its part
};

using Places = std::vector<Place>;  // one per quantity

Places nominal_places(const LinesOf& of) {
  Places places;
  for (const Quantity& q : of.quantities) places.push_back({q.order, of.within(q)});
  return places;
}

// What the channel was sampled fast enough for.
Spectrum up_to_top(const LinesOf& of, const Spectrum& spectrum) {
  const auto lines = static_cast<Eigen::Index>(of.top_order() / spectrum.resolution) + 1;
  return {spectrum.resolution, spectrum.amplitude.head(std::min(lines, spectrum.amplitude.size()))};
}

// Lines of parts that slip stand where all of a part's do, or are another part's. The search weighs
// them over the higher floor, of one block: decoys are of that kind.
void find_slipping(const LinesOf& of, const Spectrum& whole, double blocks, Places& places,
                   ChannelLevels& measured) {
  const Spectrum spectrum = up_to_top(of, whole);
  const LineFloor floor = line_floor(spectrum, of.every());
  const SlippingLines found = find_slipping_lines(of.kinematics, of.quantities, spectrum, floor,
                                                  blocks, speed_error(of.angle.is_measured()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (std::isnan(found.lines[i].order)) continue;
    places[i] = {found.lines[i].order, spectrum.resolution, found.lines[i].p_value};
    measured.levels[i].taken = found.lines[i].taken;
  }
  measured.unparted = found.unparted;
}

// @return where each line was read
Places measure_whole(const LinesOf& of, ChannelLevels& measured) {
  std::vector<Level>& levels = measured.levels;
  Places places = nominal_places(of);
  const Spectrum spectrum = block_spectrum(of.even, of.angle, of.block);
  if (spectrum.amplitude.size() == 0) return places;
  const double blocks =
      std::floor(double(of.even.samples.size()) / of.even.samples_per_turn / of.block);
  const LineFloor floor = block_floor(spectrum, of.every(), blocks);
  if (!of.locked) find_slipping(of, spectrum, blocks, places, measured);
  for (std::size_t i = 0; i < of.quantities.size(); ++i) {
    const Quantity& q = of.quantities[i];
    if (!of.holds(q) || levels[i].taken) continue;
    const auto level =
        line_level(spectrum, floor, blocks, places[i].order, places[i].within, of.within(q));
    if (!level) continue;
    levels[i].whole_dB = dB_of_power(level->power);
    levels[i].above_floor_dB = dB_of_power(level->above_floor);
    levels[i].p_value = level->p_value;
    levels[i].part_p_value = places[i].p_value;
  }
  return places;
}

// What a part says of a line. A period without a window parts all lines that repeat with it.
double part_dB(const LinesOf& of, const Spectrum& spectrum, const LineFloor& floor,
               const Place& place) {
  if (of.locked) {
    const auto power = single_line_power(spectrum, place.order, place.within);
    return power ? dB_of_power(*power) : not_known;
  }
  const auto level = line_level(spectrum, floor, 1, place.order, place.within);
  return level ? dB_of_power(level->power) : not_known;
}

void measure_parts(const LinesOf& of, const Places& places, std::vector<Level>& levels) {
  const double turns = of.locked ? of.period_turns : of.block;
  const auto size = static_cast<Eigen::Index>(std::lround(turns * of.even.samples_per_turn));
  const Eigen::Index parts = of.even.samples.size() / size;
  if (parts < fewest_parts) return;
  for (Eigen::Index part = 0; part < parts; ++part) {
    const Spectrum spectrum =
        amplitude_spectrum(of.even.samples.segment(part * size, size), of.even.samples_per_turn,
                           of.locked ? Window::rectangular : Window::hann);
    const LineFloor floor = of.locked ? LineFloor{} : line_floor(spectrum, 0);
    for (std::size_t i = 0; i < of.quantities.size(); ++i) {
      if (!of.holds(of.quantities[i]) || levels[i].taken) continue;
      levels[i].parts_dB.conservativeResize(parts);
      levels[i].parts_dB[part] = part_dB(of, spectrum, floor, places[i]);
    }
  }
}

bool strays(const Quantity& q) { return q.stray > 0; }

void measure_lines(const Channel& x, const ShaftAngle& angle, const Kinematics& kinematics,
                   const std::vector<Quantity>& quantities, ChannelLevels& measured) {
  OverAngle even = over_periods(x, angle, kinematics);
  const double period = whole_period(kinematics);
  const int block = block_turns(kinematics);
  if (even.samples.size() < Eigen::Index{block} * even.samples_per_turn) return;
  const LinesOf locked{even, angle, kinematics, quantities, x.rate_Hz, block, period, period > 1};
  measure_parts(locked, measure_whole(locked, measured), measured.levels);
  if (period == 1 || std::ranges::none_of(quantities, strays)) return;
  // Within reach of a line that strays lie many that repeat with the train: they are taken out.
  even.samples = without_average(
      even.samples, static_cast<Eigen::Index>(std::lround(period * even.samples_per_turn)));
  const LinesOf astray{even, angle, kinematics, quantities, x.rate_Hz, block, period, false};
  measure_parts(astray, measure_whole(astray, measured), measured.levels);
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
  ChannelLevels measured{x.info, x.rate_Hz, double(x.samples.size()) / x.rate_Hz, {}, {}};
  measured.levels.resize(quantities.size());
  measure_signal(x.samples, measured.levels);
  measure_lines(x, angle, kinematics, quantities, measured);
  drop_unknown_parts(measured.levels);
  return measured;
}

}  // namespace rvbench::analysis
