#include "analysis/evidence/gear_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/evidence/decoy_p_value.hpp"
#include "analysis/evidence/visibility.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/signature_lines.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr double hann_reach = 1.5;  // lines: what of it lies further away is below 0.1 %
// A line that is not so many times above what is beside it is part of something broader: a tone
// that does not follow the shaft and wanders over the lines, or another part's comb.
constexpr double over_beside = 4;
constexpr Index lines_beside = 3;
// A drive holds its speed to some thousandths, and corrects it twice a second at the most. A line
// that wanders through a resonance of 1 % damping swings by a tenth at the most: a four hundredth
// of its power.
constexpr double wander_Hz = 0.6;
constexpr double wandering = 0.004;
constexpr double stands_out = 16;  // power over the floor: noise is there once in 10⁷
constexpr std::size_t most_listed = 24;
// Noise of a contact goes as its load, which swings by up to a tenth in a sound machine.
constexpr double swing_of_sound_noise = 0.12;
// Gears turn as well, so noise that a shaft swings beats with their turns. Such a beat is at most
// half as deep as the shaft's swing.
constexpr double swing_of_beats = 0.5;
// Blows of a tooth last about as long as its contact: beyond the second harmonic of the mesh hardly
// anything is left of them.
constexpr double mesh_harmonics_of_blows = 2;
// The modes of a housing make a few lines of a comb much louder than the others. Source  ours
constexpr double lines_heard = 6;

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
    // Lines that rivals have as well count together, where they win most of the disputes.
    Sum alone, shared;
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
      const bool is_disputed = !line.rivals.empty() && is_heard(at, line.rivals);
      disputed += is_disputed ? 1 : 0;
      won += is_disputed && line2 > 0 ? 1 : 0;
      (line.rivals.empty() ? alone : shared).add(line2, variance(at, line2));
    }
    if (2 * won < disputed) {  // another part makes them: they are as good as noise
      shared.line2 = 0;
      for (std::size_t i = 0; i < part.own.size(); ++i) {
        if (!part.own[i].rivals.empty()) r.log_ratio[static_cast<Index>(i)] = 1;
      }
    }
    r.own2 = alone.line2 + shared.line2 - loudest_over_second(part, r.line2);
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
    double first = 0, second = 0;
    for (const auto& [harmonic, sum] : groups) {
      second = std::max(second, std::min(first, sum));
      first = std::max(first, sum);
    }
    return first - second;
  }

  void expect(const PartLines& part, GearReading& r) const {
    const double highest = part.mesh.empty() ? places_.resolution * static_cast<double>(end())
                                             : mesh_harmonics_of_blows * part.mesh.front();
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

// What damage of a severity adds to the sum over a comb's lines. The lines that are heard share the
// damage's power.
double expected_excess(const std::vector<std::vector<GearReading>>& readings, std::size_t part,
                       double severity) {
  double sum = 0;
  int channels = 0;
  for (const std::vector<GearReading>& channel : readings) {
    if (channel.empty()) continue;
    ++channels;
    const GearReading& r = channel[part];
    const double over = r.floor2 > 0 ? severity * severity * r.at_one2 / lines_heard / r.floor2 : 0;
    sum += r.floor_lines > 0 ? r.floor_lines * std::log1p((1 + over) / r.floor_lines) : 1;
  }
  return lines_heard * (minus_log_gamma_tail(sum, channels) - 1);
}

// The deepest lines, by their orders.
void list_lines(const PartLines& part, const GearReading& reading, SignatureScore& score) {
  std::vector<std::size_t> deepest(part.own.size());
  std::iota(deepest.begin(), deepest.end(), 0);
  const auto is_deeper = [&](std::size_t a, std::size_t b) {
    return reading.line2[static_cast<Index>(a)] > reading.line2[static_cast<Index>(b)];
  };
  const std::size_t count = std::min(most_listed, deepest.size());
  std::ranges::partial_sort(deepest, deepest.begin() + static_cast<std::ptrdiff_t>(count),
                            is_deeper);
  deepest.resize(count);
  std::ranges::sort(deepest);
  score.line_orders.clear();
  score.line_depths.clear();
  for (const std::size_t i : deepest) {
    const double line2 = std::max(reading.line2[static_cast<Index>(i)], 0.0);
    score.line_orders.push_back(part.own[i].order);
    score.line_depths.push_back(std::sqrt(2 * line2 / reading.mesh2));
  }
}

double smallest_visible(const std::vector<std::vector<GearReading>>& readings, std::size_t part,
                        const Eigen::VectorXd& decoys) {
  const double asked = visible_sum(decoys) - median({decoys.begin(), decoys.end()});
  return severity_reaching(
      asked, [&](double severity) { return expected_excess(readings, part, severity); });
}

void score_part(const std::vector<std::vector<GearReading>>& readings, const PartLines& part,
                std::size_t s, SignatureScore& score) {
  score.channel_depths.assign(readings.size(), 0.0);
  const auto lines = static_cast<Index>(part.own.size());
  Eigen::VectorXd line_sums = Eigen::VectorXd::Zero(lines);
  Eigen::MatrixXd decoy_sums = Eigen::MatrixXd::Zero(lines, gear_decoys);
  int channels_read = 0;
  std::vector<double> depths2, variances, amplitudes;
  double deepest2 = -1;
  for (std::size_t c = 0; c < readings.size(); ++c) {
    if (readings[c].empty()) continue;
    const GearReading& reading = readings[c][s];
    ++channels_read;
    line_sums += reading.log_ratio;
    decoy_sums += reading.decoys;
    // A channel that does not hear the mesh says nothing of what is to be held against it.
    if (!(reading.mesh2 > 3 * std::sqrt(reading.mesh2_variance))) continue;
    const double depth2 = 2 * reading.own2 / part.share / reading.mesh2;
    depths2.push_back(depth2);
    variances.push_back(4 * reading.own2_variance / std::pow(part.share * reading.mesh2, 2));
    amplitudes.push_back(std::sqrt(std::max(reading.own2 / part.share, 0.0)));
    score.channel_depths[c] = std::sqrt(std::max(depth2, 0.0));
    if (depth2 <= deepest2) continue;
    deepest2 = depth2;
    score.channel = static_cast<int>(c);
    list_lines(part, reading, score);
  }
  if (depths2.empty()) return;
  // −ln p of a line in all channels: a few that many channels hear outweigh many of noise.
  const auto combined = [&](double sum) {
    return sum > 0 ? minus_log_gamma_tail(sum, channels_read) : 0;
  };
  const double log_ratio = line_sums.unaryExpr(combined).sum();
  const Eigen::VectorXd decoys = decoy_sums.unaryExpr(combined).colwise().sum();
  const auto channels = static_cast<double>(depths2.size());
  score.depth = std::sqrt(std::max(0.0, median(depths2)));
  score.amplitude = median(std::move(amplitudes));
  // A median's own variance is π/2 of a mean's.
  constexpr double of_median = 1.57;
  score.depth2_variance = of_median * median(variances) / channels;
  score.log_likelihood_ratio = log_ratio - median({decoys.begin(), decoys.end()});
  score.p_value = decoy_p_value(log_ratio, decoys);
  score.smallest_visible = smallest_visible(readings, s, decoys);
}

std::vector<GearReading> readings_of(const Spectrum& spectrum, const GearPlaces& places,
                                     double counts_above) {
  const auto lines = static_cast<Index>(places.locked.size());
  const GearReader reader({spectrum.resolution, spectrum.amplitude.head(lines)}, places,
                          counts_above);
  std::vector<GearReading> readings;
  for (const PartLines& part : places.parts) readings.push_back(reader.read(part));
  return readings;
}

void mark_lines(const Kinematics& kinematics, std::size_t lines, GearPlaces& places) {
  places.locked = locked_lines(kinematics, places.resolution, lines, hann_reach);
  for (std::size_t i = 2; i + 1 < lines; ++i) {
    if (!places.locked[i]) places.free.push_back(static_cast<Index>(i));
  }
  for (std::size_t i = 0, before = 0; i < lines; ++i) {
    places.free_before.push_back(static_cast<Index>(before));
    if (before < places.free.size() && places.free[before] == static_cast<Index>(i)) ++before;
  }
}

}  // namespace

GearPlaces line_places(double turns, double top_order, double speed_Hz, bool is_placed,
                       const Kinematics& kinematics) {
  GearPlaces places;
  places.resolution = 1 / turns;
  constexpr double rounding = 0.99;
  places.parts = own_lines(kinematics, rounding * lines_to_part * places.resolution,
                           wander_Hz / speed_Hz, top_order);
  // Beyond it a stated speed places no line.
  const double error = speed_error(is_placed);
  const double placed = error > 0 ? 0.5 * places.resolution / error : top_order;
  for (PartLines& part : places.parts) {
    std::erase_if(part.own, [&](const OwnLine& line) { return line.order > placed; });
    if (!part.mesh.empty() && part.mesh.front() > placed) part.own.clear();
  }
  mark_lines(kinematics, static_cast<std::size_t>(top_order / places.resolution), places);
  return places;
}

GearPlaces envelope_places(const Kinematics& kinematics, double resolution, std::size_t lines) {
  GearPlaces places;
  places.resolution = resolution;
  for (const auto& part : signature_lines(kinematics, resolution)) {
    PartLines& own = places.parts.emplace_back();
    const auto s = places.parts.size() - 1;
    const Shows shows = kinematics.signatures[s].shows;
    if (shows == Shows::as_blows || shows == Shows::as_printed) continue;
    for (const SignatureLine& line : part) own.own.push_back({line.order, line.rivals});
  }
  mark_lines(kinematics, lines, places);
  return places;
}

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

void score_gears(const std::vector<std::vector<GearReading>>& readings, const GearPlaces& places,
                 std::vector<SignatureScore>& scores) {
  for (std::size_t s = 0; s < places.parts.size(); ++s) {
    if (!places.parts[s].own.empty()) score_part(readings, places.parts[s], s, scores[s]);
  }
}

void score_noise(const std::vector<std::vector<GearReading>>& readings, const GearPlaces& places,
                 const Kinematics& kinematics, std::vector<SignatureScore>& scores) {
  double shafts_swing = 0;
  // Shafts first: gears turn what swings with them.
  for (const Shows kind : {Shows::as_turning, Shows::as_teeth}) {
    for (std::size_t s = 0; s < places.parts.size(); ++s) {
      if (places.parts[s].own.empty() || kinematics.signatures[s].shows != kind) continue;
      SignatureScore noise = scores[s];
      score_part(readings, places.parts[s], s, noise);
      noise.by_noise = true;
      noise.amplitude = not_known;
      SignatureScore& lines = scores[s];
      const double of_sound =
          std::max({swing_of_sound_noise, lines.depth, swing_of_beats * shafts_swing});
      const bool shows = noise.p_value < significant_p && noise.depth > of_sound;
      if (shows && kind == Shows::as_turning) shafts_swing = std::max(shafts_swing, noise.depth);
      // Two ways to show are two chances.
      const double p_value = std::min(1.0, 2 * std::min(noise.p_value, lines.p_value));
      if (shows || lines.p_value >= significant_p) {
        if (!std::isnan(lines.smallest_visible)) noise.smallest_visible = lines.smallest_visible;
        if (shows || std::isnan(lines.smallest_visible)) lines = std::move(noise);
      }
      lines.p_value = p_value;
    }
  }
}

}  // namespace rvbench::analysis
