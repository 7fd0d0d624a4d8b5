#include "analysis/evidence/gear_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "analysis/evidence/decoy_p_value.hpp"
#include "analysis/evidence/visibility.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr std::size_t most_listed = 24;
// Noise of a contact goes as its load, which swings by up to a tenth in a sound machine.
constexpr double swing_of_sound_noise = 0.12;
// Gears turn as well, so noise that a shaft swings beats with their turns. Such a beat is at most
// half as deep as the shaft's swing.
constexpr double swing_of_beats = 0.5;
// The modes of a housing make a few lines of a comb much louder than the others. Source  ours
constexpr double lines_heard = 6;

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
  score.channel_amplitudes.assign(readings.size(), 0.0);
  const auto lines = static_cast<Index>(part.own.size());
  Eigen::VectorXd line_sums = Eigen::VectorXd::Zero(lines);
  Eigen::MatrixXd decoy_sums = Eigen::MatrixXd::Zero(lines, gear_decoys);
  int channels_read = 0;
  std::vector<double> depths2, variances, amplitudes, phases;
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
    if (!std::isnan(reading.in_phase)) phases.push_back(reading.in_phase);
    variances.push_back(4 * reading.own2_variance / std::pow(part.share * reading.mesh2, 2));
    amplitudes.push_back(std::sqrt(std::max(reading.own2 / part.share, 0.0)));
    score.channel_amplitudes[c] = amplitudes.back();
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
  score.depth = std::sqrt(std::max(0.0, median(depths2)));
  score.amplitude = median(std::move(amplitudes));
  score.in_phase = phases.empty() ? not_known : median(std::move(phases));
  score.depth2_variance = variance_of_median(variances);
  score.log_likelihood_ratio = log_ratio - median({decoys.begin(), decoys.end()});
  score.p_value = decoy_p_value(log_ratio, decoys);
  score.smallest_visible = smallest_visible(readings, s, decoys);
}

}  // namespace

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
      noise.channel_amplitudes.clear();
      SignatureScore& lines = scores[s];
      const double of_sound =
          std::max({swing_of_sound_noise, lines.depth, swing_of_beats * shafts_swing});
      const bool shows = noise.p_value < significant_p && noise.depth > of_sound;
      if (shows && kind == Shows::as_turning) shafts_swing = std::max(shafts_swing, noise.depth);
      // Two ways to show are two chances. Noise that swings as in a sound machine is none.
      const double least = shows ? std::min(noise.p_value, lines.p_value) : lines.p_value;
      const double p_value = std::min(1.0, 2 * least);
      if (shows || lines.p_value >= significant_p) {
        if (!std::isnan(lines.smallest_visible)) noise.smallest_visible = lines.smallest_visible;
        if (shows || std::isnan(lines.smallest_visible)) lines = std::move(noise);
      }
      lines.p_value = p_value;
    }
  }
}

}  // namespace rvbench::analysis
