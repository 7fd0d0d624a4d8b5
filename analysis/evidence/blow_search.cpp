#include "analysis/evidence/blow_search.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/evidence/blow_power.hpp"
#include "analysis/evidence/decoy_p_value.hpp"
#include "analysis/evidence/visibility.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr int decoy_searches = 48;
constexpr double nearest_decoy = 0.06;  // relative: beyond what slip may search
constexpr double farthest_decoy = 0.45;

FoundBlows search(const BlowComb& comb, const BlowLines& lines, double centre, double reach) {
  const double step = step_of(comb, lines);
  const int tries = static_cast<int>(std::ceil(reach / step));
  FoundBlows best;
  for (int t = -tries; t <= tries; ++t) {
    const double stretch = centre * (1 + t * step);
    const double sum = comb.sum(lines, stretch);
    if (sum > best.sum) best = {.stretch = stretch, .sum = sum};
  }
  return best;
}

// The middle of a smeared line: where the lines themselves are highest.
double refined(const BlowComb& comb, const BlowLines& lines, double stretch) {
  const double step = step_of(comb, lines);
  const int tries = static_cast<int>(std::ceil(blow_smear / step));
  double best = stretch, highest = 0;
  for (int t = -tries; t <= tries; ++t) {
    const double at = stretch * (1 + t * step);
    double sum = 0;
    for (int h = 1; h <= blow_harmonics; ++h) sum += lines.exactly_at(h * comb.order * at);
    if (sum <= highest) continue;
    highest = sum;
    best = at;
  }
  return best;
}

// The same search where the part has no lines.
Eigen::VectorXd decoys_of(const BlowComb& comb, const BlowLines& lines, double reach) {
  Eigen::VectorXd decoys(decoy_searches);
  const int half = decoy_searches / 2;
  for (int d = 0; d < decoy_searches; ++d) {
    const double away = nearest_decoy + (farthest_decoy - nearest_decoy) * (d / 2) / (half - 1.0);
    decoys[d] = search(comb, lines, d % 2 == 0 ? 1 + away : 1 / (1 + away), reach).sum;
  }
  return decoys;
}

// What blows of a severity add to a comb's sum, over all channels.
double expected_of(const BlowComb& comb, const BlowLines& lines,
                   const std::vector<ResidualEnvelope>& channels, const Kinematics& kinematics,
                   double severity) {
  double sum = 0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const ResidualEnvelope& channel = channels[c];
    if (lines.weight(c) == 0) continue;
    const double swing = swing_by(severity, channel, kinematics);
    for (int h = 1; h <= blow_harmonics; ++h) {
      const auto line = static_cast<Index>(std::lround(h * comb.order / channel.resolution));
      if (line >= channel.lines.power.size()) continue;
      const double depth = swing * of_mean_power(h);
      const double m = channel.lines.floor_lines[line];
      const double over = 1 + depth * depth / channel.lines.floor[line];
      sum += lines.weight(c) * m * (std::log1p(over / m) - std::log1p(1 / m));
    }
  }
  return sum;
}

}  // namespace

double BlowComb::sum(const BlowLines& lines, double stretch) const {
  double total = 0;
  for (int h = 1; h <= blow_harmonics; ++h) {
    const double main = lines.at(h * order * stretch);
    total += main;
    if (!(sideband > 0)) continue;
    for (const double side : {-sideband, sideband}) {
      total += std::min(main, lines.at(h * order * stretch + side));
    }
  }
  return total;
}

double step_of(const BlowComb& comb, const BlowLines& lines) {
  return 0.5 * lines.resolution() / (blow_harmonics * comb.order);
}

void take_family(const BlowComb& comb, double stretch, BlowLines& lines) {
  for (int h = 1; h <= 3 * blow_harmonics; ++h) {
    const double main = h * comb.order * stretch;
    for (int m = -2; m <= 2; ++m) {
      if (m == 0 || comb.sideband > 0) lines.take(main + m * comb.sideband);
    }
  }
  lines.spread();
}

FoundBlows BlowSearch::operator()(const BlowComb& comb, const BlowLines& lines, double centre,
                                  double reach) const {
  FoundBlows best = search(comb, lines, centre, reach);
  // A bad race has so many lines that its decoys would meet some of them.
  best.stretch = refined(comb, lines, best.stretch);
  BlowLines others = lines;
  take_family(comb, best.stretch, others);
  const Eigen::VectorXd decoys = decoys_of(comb, others, reach);
  constexpr double hardly = 2;
  // Without its first line the others are another part's.
  if (lines.hears(comb.order * best.stretch, hardly))
    best.p_value = decoy_p_value(best.sum, decoys);
  best.excess = best.sum - median({decoys.begin(), decoys.end()});
  const Eigen::VectorXd single = decoys_of(comb, others, 0);
  const double asked = visible_sum(decoys) - single.mean();
  best.smallest_visible = severity_reaching(
      asked, [&](double severity) { return expected_of(comb, lines, channels_, k_, severity); });
  return best;
}

}  // namespace rvbench::analysis
