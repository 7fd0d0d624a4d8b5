#include "analysis/evidence/rolling_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "analysis/evidence/blow_power.hpp"
#include "analysis/evidence/blow_search.hpp"
#include "analysis/evidence/unknown_blows.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

class BearingScore {
 public:
  BearingScore(const RollingBearing& bearing, const std::vector<ResidualEnvelope>& channels,
               const Kinematics& kinematics, std::vector<SignatureScore>& scores)
      : b_(bearing),
        channels_(channels),
        k_(kinematics),
        scores_(scores),
        found_(channels, kinematics) {}

  // Takes what the parts explain out of the lines.
  void score(BlowLines& lines) {
    const FoundBlows inner = found_(comb(b_.inner), lines, 1, reach(b_.inner));
    const FoundBlows outer = found_(comb(b_.outer), lines, 1, reach(b_.outer));
    const FoundBlows ball = found_(comb(b_.ball), lines, 1, reach(b_.ball));
    if (std::ranges::none_of(std::array{&inner, &outer, &ball}, [](const FoundBlows* blows) {
          return blows->p_value < significant_p;
        })) {
      put(b_.inner, inner);  // the cage's speed is not known
      put(b_.outer, outer);
      put(b_.ball, ball);
      judge_free(b_.cage_wear, lines);
      return;
    }
    BlowLines left = lines;
    const FoundBlows* first = &inner;
    const double of_inner = depth2(b_.inner, inner), of_outer = depth2(b_.outer, outer);
    if (of_outer > of_inner) first = &outer;
    // Slip may bring a rolling element's lines to a race's order: it is the element only where it
    // has clearly more.
    constexpr double clearly = 1.3;
    if (depth2(b_.ball, ball) > clearly * std::max(of_inner, of_outer)) first = &ball;
    if (first == &inner) {
      put(b_.inner, inner);
      explain(b_.inner, inner, left);
      judge_tied(b_.outer, cage_of_inner(inner.stretch) / b_.cage, left);
      judge_free(b_.ball, left);
    } else if (first == &outer) {
      put(b_.outer, outer);
      explain(b_.outer, outer, left);
      judge_tied(b_.inner, (1 - b_.cage * outer.stretch) / (1 - b_.cage), left);
      judge_free(b_.ball, left);
    } else {
      put(b_.ball, ball);
      explain(b_.ball, ball, left);
      judge_free(b_.inner, left);
      if (scores_[b_.inner].p_value < significant_p) {
        const double stretch = scores_[b_.inner].order / k_.signatures[b_.inner].order;
        judge_tied(b_.outer, cage_of_inner(stretch) / b_.cage, left);
      } else {
        judge_free(b_.outer, left);
      }
    }
    judge_free(b_.cage_wear, left);
    for (const std::size_t part : {b_.inner, b_.outer, b_.ball, b_.cage_wear}) {
      const SignatureScore& score = scores_[part];
      if (score.p_value >= significant_p) continue;
      explain(part, {.stretch = score.order / k_.signatures[part].order}, lines);
    }
  }

 private:
  double reach(std::size_t part) const {
    return std::max(k_.signatures[part].slip, k_.signatures[part].tolerance);
  }
  BlowComb comb(std::size_t part) const {
    const Signature& s = k_.signatures[part];
    return {s.order, s.sidebands.empty() ? 0 : s.sidebands.front()};
  }
  double cage_of_inner(double stretch) const { return 1 - (1 - b_.cage) * stretch; }

  // Median over the channels; 0 where the part does not show.
  double depth2(std::size_t part, const FoundBlows& blows) const {
    if (blows.p_value >= significant_p) return 0;
    return median_depth2(blow_depths(channels_, k_, k_.signatures[part].order * blows.stretch));
  }

  // At the cage speed that the other race has set, to half a line.
  void judge_tied(std::size_t part, double stretch, const BlowLines& lines) {
    put(part, found_(comb(part), lines, stretch, 2 * step_of(comb(part), lines)));
  }
  void judge_free(std::size_t part, const BlowLines& lines) {
    put(part, found_(comb(part), lines, 1, reach(part)));
  }

  void explain(std::size_t part, const FoundBlows& blows, BlowLines& lines) const {
    take_family(comb(part), blows.stretch, lines);
  }

  void put(std::size_t part, const FoundBlows& blows) {
    SignatureScore& score = scores_[part];
    const Signature& signature = k_.signatures[part];
    score.order = signature.order * blows.stretch;
    score.log_likelihood_ratio = blows.excess;
    score.p_value = blows.p_value;
    score.smallest_visible = blows.smallest_visible;
    score.depth2_variance = std::numeric_limits<double>::min();  // it was read
    score.channel_amplitudes.assign(channels_.size(), 0.0);
    if (blows.p_value >= plausible_p) return;
    const std::vector<BlowDepth> depths = blow_depths(channels_, k_, score.order);
    score.depth = std::sqrt(median_depth2(depths));
    std::vector<double> amplitudes, variances;
    double deepest2 = -1;
    for (std::size_t c = 0; c < depths.size(); ++c) {
      if (std::isnan(depths[c].depth2)) continue;
      variances.push_back(depths[c].variance);
      amplitudes.push_back(std::sqrt(depths[c].depth2 * reference_mean_square(channels_[c], k_)));
      score.channel_amplitudes[c] = amplitudes.back();
      if (depths[c].depth2 <= deepest2) continue;
      deepest2 = depths[c].depth2;
      score.channel = static_cast<int>(c);
    }
    score.amplitude = median(std::move(amplitudes));
    score.depth2_variance += variance_of_median(variances);
    for (int h = 1; h <= blow_harmonics; ++h) {
      score.line_orders.push_back(h * score.order);
      score.line_depths.push_back(
          swing_at(channels_[static_cast<std::size_t>(score.channel)], h * score.order));
    }
  }

  const RollingBearing& b_;
  const std::vector<ResidualEnvelope>& channels_;
  const Kinematics& k_;
  std::vector<SignatureScore>& scores_;
  BlowSearch found_;
};

}  // namespace

std::vector<UnknownFamily> score_rolling(const std::vector<ResidualEnvelope>& channels,
                                         const Kinematics& kinematics,
                                         std::vector<SignatureScore>& scores) {
  BlowLines lines(channels, kinematics);
  if (lines.empty()) return {};
  for (const RollingBearing& bearing : kinematics.bearings) {
    BearingScore(bearing, channels, kinematics, scores).score(lines);
  }
  return unknown_blows(lines, channels, kinematics, scores);
}

}  // namespace rvbench::analysis
