#include "analysis/evidence/gear_reading.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/line_floor.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

// A line that is not so many times above what is beside it is part of something broader: a tone
// that does not follow the shaft and wanders over the lines, or another part's comb.
constexpr double over_beside = 4;
constexpr Index lines_beside = 3;
// A line that wanders through a resonance of 1 % damping swings by a tenth at the most: a four
// hundredth of its power to either side, and as much again for chance.
constexpr double wandering = 0.004;
constexpr double stands_out = 16;  // power over the floor: noise is there once in 10⁷
// Blows of a tooth last about as long as its contact: beyond the second harmonic of the mesh hardly
// anything is left of them.
constexpr double mesh_harmonics_of_blows = 2;

// Totals over some lines.
struct Sum {
  double line2 = 0, variance = 0;

  void add(double of_line2, double of_variance) {
    line2 += of_line2;
    variance += of_variance;
  }
};

class GearReader {
 public:
  GearReader(const Spectrum& spectrum, const GearPlaces& places, double counts_above)
      : places_(places), counts_above_(counts_above), floor_(line_floor(spectrum, places.locked)) {
    const Index n = floor_.power.size();
    log_ratio_.resize(n);
    for (Index i = 0; i < n; ++i) log_ratio_[i] = floor_.log_ratio(i);
  }

  GearReading read(const PartLines& part) const {
    GearReading r;
    const auto lines = static_cast<Index>(part.own.size());
    r.decoys = Eigen::MatrixXd::Zero(lines, gear_decoys);
    r.line2 = Eigen::VectorXd::Zero(lines);
    r.log_ratio = Eigen::VectorXd::Ones(lines);
    // Lines that rivals have as well count together, where they win most of the disputes. A shaft's
    // force is no sideband, and is disputed by itself.
    Sum alone, shared;
    const auto is_shared = [](const OwnLine& line) {
      return !line.rivals.empty() && !line.is_force;
    };
    int disputed = 0, won = 0;
    for (std::size_t i = 0; i < part.own.size(); ++i) {
      const OwnLine& line = part.own[i];
      const Index at = bin_of(line.order);
      if (!holds(at)) continue;
      const auto row = static_cast<Index>(i);
      set_decoys(at, r.decoys.row(row));
      const double line2 = own2(at, line);
      r.line2[row] = line2;
      if (line2 != 0) r.log_ratio[row] = log_ratio_[at];
      const bool is_disputed = is_shared(line) && is_heard(at, line.rivals);
      disputed += is_disputed ? 1 : 0;
      won += is_disputed && line2 > 0 ? 1 : 0;
      (is_shared(line) ? shared : alone).add(line2, variance(at, line2));
    }
    if (2 * won < disputed) {  // another part makes them: they are as good as noise
      shared.line2 = 0;
      for (std::size_t i = 0; i < part.own.size(); ++i) {
        if (!is_shared(part.own[i])) continue;
        r.log_ratio[static_cast<Index>(i)] = 1;
        r.line2[static_cast<Index>(i)] = 0;
      }
    }
    r.own2 = alone.line2 + shared.line2 - loudest_over_second(part, r.line2) -
             loudest_over_others(part, r.line2);
    r.own2 = std::max(r.own2, 0.0);
    r.own2_variance = alone.variance + shared.variance;
    for (const double order : part.mesh) {
      const Index at = bin_of(order);
      if (!holds(at)) continue;
      const double line2 = amplitude2(at);
      r.mesh2 += line2;
      r.mesh2_variance += variance(at, line2);
    }
    if (part.mesh.empty()) r.mesh2 = floor_.power.sum() / lines_per_hann_line;
    expect(part, r);
    return r;
  }

 private:
  Index bin_of(double order) const {
    return static_cast<Index>(std::lround(order / places_.resolution));
  }
  Index end() const { return floor_.power.size(); }
  bool holds(Index at) const { return at >= 2 && at + 1 < end(); }

  // Without noise.
  double amplitude2(Index at) const {
    return (floor_.power.segment(at - 1, 3) - floor_.floor.segment(at - 1, 3)).sum() /
           lines_per_hann_line;
  }

  // |a + n|² of a line a in complex noise of mean power F varies by F² + 2·F·|a|². Lines under a
  // Hann window share noise: three of them over 1.5 have 2.14 times the first term and 1.30 times
  // the second.
  double variance(Index at, double line2) const {
    const double f = floor_.floor[at];
    return 2.14 * f * f + 1.30 * 2 * f * std::max(line2, 0.0);
  }

  // The strongest of the nearest lines that no gear reaches. A tone that does not follow the shaft
  // spreads over them, and a wandering speed spreads a strong line over them.
  double strongest_beside(Index at) const {
    const Index before = places_.free_before[static_cast<std::size_t>(at)];
    const Index from = std::max<Index>(0, before - lines_beside);
    const Index end = std::min(std::ssize(places_.free), before + lines_beside);
    double strongest = 0;
    for (Index i = from; i < end; ++i) {
      strongest = std::max(strongest, floor_.power[places_.free[static_cast<std::size_t>(i)]]);
    }
    return strongest;
  }

  // The squared amplitude that belongs to the line alone; 0 if its surroundings are as strong.
  double own2(Index at, const OwnLine& line) const {
    if (floor_.power[at] < counts_above_ * floor_.floor[at]) return 0;
    const double line2 = amplitude2(at);
    double beside2 = strongest_beside(at);
    bool is_disputed = beside2 > stands_out * floor_.floor[at];
    for (const double order : line.carriers) {
      const Index carrier = bin_of(order);
      if (!holds(carrier)) continue;
      beside2 = std::max(beside2, wandering * amplitude2(carrier));
      is_disputed = is_disputed || beside2 > stands_out * floor_.floor[at];
    }
    for (const double order : line.rivals) {
      const Index rival = bin_of(order);
      if (!holds(rival)) continue;
      beside2 = std::max(beside2, amplitude2(rival));
      is_disputed = is_disputed || floor_.power[rival] > stands_out * floor_.floor[rival];
    }
    return is_disputed ? std::max(0.0, line2 - over_beside * beside2) : line2;
  }

  // Whether the line or a rival stands out of the noise.
  bool is_heard(Index at, const std::vector<double>& rivals) const {
    const auto stands = [&](Index line) {
      return holds(line) && floor_.power[line] > stands_out * floor_.floor[line];
    };
    return stands(at) ||
           std::ranges::any_of(rivals, [&](double order) { return stands(bin_of(order)); });
  }

  // One harmonic alone is a tone that happens to lie there: it counts as much as the second.
  static double loudest_over_second(const PartLines& part, const Eigen::VectorXd& line2) {
    std::map<int, double> groups;
    for (std::size_t i = 0; i < part.own.size(); ++i) {
      if (part.own[i].harmonic > 0) {
        groups[part.own[i].harmonic] += std::max(line2[static_cast<Index>(i)], 0.0);
      }
    }
    if (groups.size() < 2) return 0;
    double first = 0, second = 0;
    for (const auto& [harmonic, sum] : groups) {
      second = std::max(second, std::min(first, sum));
      first = std::max(first, sum);
    }
    return first - second;
  }

  // A shaft swings all harmonics of its mesh alike. A resonance that a sideband meets before its
  // carrier does makes one seem deeper: it counts as deep as the deepest of the others that would
  // have shown as much.
  double loudest_over_others(const PartLines& part, const Eigen::VectorXd& line2) const {
    struct Swing {
      double carrier2 = 0, sides2 = 0, variance = 0;
      double depth2() const { return std::max(sides2, 0.0) / carrier2; }
    };
    std::map<double, Swing> swings;
    for (std::size_t i = 0; i < part.own.size(); ++i) {
      const Index carrier = bin_of(part.own[i].carrier), at = bin_of(part.own[i].order);
      if (part.own[i].carrier == 0 || !holds(carrier) || !holds(at)) continue;
      Swing& swing = swings[part.own[i].carrier];
      swing.carrier2 = std::max(amplitude2(carrier), floor_.floor[carrier]);
      swing.sides2 += line2[static_cast<Index>(i)];
      swing.variance += variance(at, 0);
    }
    if (swings.size() < 2) return 0;
    const auto loudest =
        std::ranges::max_element(swings, {}, [](const auto& swing) { return swing.second.sides2; });
    const double depth2 = loudest->second.depth2();
    double others = -1;
    for (auto other = swings.begin(); other != swings.end(); ++other) {
      const double expected2 = depth2 * other->second.carrier2;
      constexpr double surely = 3;  // standard deviations of noise
      if (other == loudest || expected2 < surely * std::sqrt(other->second.variance)) continue;
      others = std::max(others, other->second.depth2());
    }
    return others < 0 ? 0 : std::max(0.0, (depth2 - others) * loudest->second.carrier2);
  }

  void expect(const PartLines& part, GearReading& r) const {
    const double highest = part.contact_order > 0 ? mesh_harmonics_of_blows * part.contact_order
                                                  : places_.resolution * static_cast<double>(end());
    double lines = 0;
    for (const OwnLine& line : part.own) {
      const Index at = bin_of(line.order);
      if (!holds(at) || line.order > highest) continue;
      r.floor2 += floor_.floor[at];
      r.floor_lines += floor_.floor_lines[at];
      ++lines;
    }
    if (lines == 0) return;
    r.floor2 /= lines;
    r.floor_lines /= lines;
    r.at_one2 = part.share * r.mesh2 / 2;
  }

  // The nearest lines that no gear reaches, half of them below. The skirt of a strong line counts
  // for nothing here, as it does in own2().
  void set_decoys(Index at, Eigen::MatrixXd::RowXpr decoys) const {
    const std::vector<Index>& free = places_.free;
    if (static_cast<Index>(free.size()) < 2 * gear_decoys) return;
    const Index above = places_.free_before[static_cast<std::size_t>(at)];
    const Index first = std::clamp<Index>(above - gear_decoys / 2, 0,
                                          static_cast<Index>(free.size()) - gear_decoys);
    for (Index d = 0; d < gear_decoys; ++d) {
      const Index line = free[static_cast<std::size_t>(first + d)];
      const bool is_noise = floor_.power[line] <= stands_out * floor_.floor[line];
      decoys[d] = is_noise ? log_ratio_[line] : 1;
    }
  }

  const GearPlaces& places_;
  double counts_above_;  // power over the floor
  LineFloor floor_;
  Eigen::VectorXd log_ratio_;
};

std::vector<GearReading> readings_of(const Spectrum& spectrum, const GearPlaces& places,
                                     double counts_above) {
  const auto lines = static_cast<Index>(places.locked.size());
  const GearReader reader({spectrum.resolution, spectrum.amplitude.head(lines)}, places,
                          counts_above);
  std::vector<GearReading> readings;
  for (const PartLines& part : places.parts) readings.push_back(reader.read(part));
  return readings;
}

}  // namespace

std::vector<GearReading> read_gears(const Spectrum& spectrum, const GearPlaces& places) {
  return readings_of(spectrum, places, 0);
}

std::vector<GearReading> read_noise(const Spectrum& depths, const GearPlaces& places) {
  // Without the gears' lines a signal that is not Gaussian swings a little more at their spacings
  // than between them: only what stands out counts.
  std::vector<GearReading> readings = readings_of(depths, places, stands_out);
  for (GearReading& reading : readings) {
    // The power of noise that swings by m swings by 2·m.
    constexpr double power_over_amplitude = 2;
    const double at_one2 = power_over_amplitude * power_over_amplitude;
    if (reading.mesh2 > 0) reading.at_one2 *= 2 * at_one2 / reading.mesh2;
    reading.mesh2 = 2 * at_one2;
  }
  return readings;
}

}  // namespace rvbench::analysis
