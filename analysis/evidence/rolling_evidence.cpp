#include "analysis/evidence/rolling_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "analysis/evidence/decoy_p_value.hpp"
#include "analysis/evidence/visibility.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr int harmonics = 4;
constexpr int decoy_searches = 48;
constexpr double nearest_decoy = 0.06;  // relative: beyond what slip may search
constexpr double farthest_decoy = 0.45;
constexpr double smear = 0.002;  // relative: what slip that wanders spreads a line by
// What harmonics of a train of blows hold of its mean power. Blows ring down and jitter, and each
// of their lines passes the housing in its own phase. Source  ours
constexpr std::array of_mean_power{0.33, 0.16, 0.10, 0.07};

// What a severity refers to: the gears, or the whole signal of a machine without.
double reference2(const ResidualEnvelope& channel, const Kinematics& kinematics) {
  const double all = channel.gears2 + channel.residual2;
  return std::max(kinematics.meshes.empty() ? all : channel.gears2, 1e-12 * all);
}

// Of what is left, swing of the envelope where blows of a severity are in it.
double swing_by(double severity, const ResidualEnvelope& channel, const Kinematics& kinematics) {
  const double blows = channel.left * severity * severity * reference2(channel, kinematics) / 2;
  return 2 * blows / (blows + channel.residual2);
}

// What each channel counts: as much as it would hear of blows that are just bad, over its noise.
// Scaled so that the sum scatters as that of so many channels does that count alike.
std::vector<double> weights_of(const std::vector<ResidualEnvelope>& channels,
                               const Kinematics& kinematics) {
  constexpr double just_bad = 0.1;
  std::vector<double> weights;
  double sum = 0, squares = 0;
  for (const ResidualEnvelope& channel : channels) {
    weights.push_back(0);
    if (channel.lines.power.size() == 0 || !(channel.residual2 > 0)) continue;
    const double depth = of_mean_power.front() * swing_by(just_bad, channel, kinematics);
    const double over = depth * depth / channel.lines.floor.mean();
    weights.back() = over / (1 + over);
    sum += weights.back();
    squares += weights.back() * weights.back();
  }
  for (double& weight : weights) weight *= squares > 0 ? sum / squares : 0;
  return weights;
}

// Weighted Σ over channels of each line's −ln p; the lines of gears hold noise's mean.
class BlowLines {
 public:
  BlowLines(const std::vector<ResidualEnvelope>& channels, const Kinematics& kinematics)
      : weights_(weights_of(channels, kinematics)) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const ResidualEnvelope& channel = channels[c];
      if (channel.lines.power.size() == 0) continue;
      if (sum_.size() == 0) {
        sum_ = Eigen::VectorXd::Zero(channel.lines.power.size());
        resolution_ = channel.resolution;
        locked_ = channel.locked;
      }
      if (channel.lines.power.size() != sum_.size()) {
        weights_[c] = 0;
        continue;
      }
      channels_ += weights_[c];
      for (Index i = 0; i < sum_.size(); ++i) sum_[i] += weights_[c] * channel.lines.log_ratio(i);
    }
    for (Index i = 0; i < sum_.size(); ++i) {
      if (i < 3 || locked_[static_cast<std::size_t>(i)]) sum_[i] = channels_;
    }
    spread();
  }

  bool empty() const { return sum_.size() == 0; }
  double resolution() const { return resolution_; }
  double weight(std::size_t channel) const { return weights_[channel]; }
  double highest_order() const { return resolution_ * static_cast<double>(sum_.size()); }
  // Without what slip and jitter spread.
  double exactly_at(double order) const { return read(sum_, order); }
  double at(double order) const { return read(highest_, order); }
  bool hears(double order) const {
    constexpr double over_noise = 3;  // its mean −ln p, in each channel
    return at(order) > over_noise * channels_;
  }
  // What a part explains says nothing about another.
  void take(double order) {
    const double line = order / resolution_;
    const double reach = 2 + smear * line;
    for (auto i = static_cast<Index>(line - reach); i <= static_cast<Index>(line + reach); ++i) {
      if (i >= 0 && i < sum_.size()) sum_[i] = channels_;
    }
  }
  // The highest of the lines that slip and jitter may have spread one over.
  void spread() {
    highest_ = sum_;
    for (Index i = 0; i < sum_.size(); ++i) {
      const auto reach = static_cast<Index>(smear * static_cast<double>(i));
      const Index from = std::max<Index>(0, i - reach);
      highest_[i] = sum_.segment(from, std::min(sum_.size(), i + reach + 1) - from).maxCoeff();
    }
  }

 private:
  double read(const Eigen::VectorXd& lines, double order) const {
    const auto line = static_cast<Index>(std::lround(order / resolution_));
    return line > 2 && line < lines.size() ? lines[line] : channels_;
  }

  Eigen::VectorXd highest_;
  Eigen::VectorXd sum_;
  std::vector<double> weights_;  // of channels
  std::vector<bool> locked_;
  double resolution_ = 0;
  double channels_ = 0;  // Σ of their weights
};

// A part's lines: harmonics, each with sidebands that count up to their harmonic.
struct BlowComb {
  double order = 0;
  double sideband = 0;  // 0: none

  double sum(const BlowLines& lines, double stretch) const {
    double total = 0;
    for (int h = 1; h <= harmonics; ++h) {
      const double main = lines.at(h * order * stretch);
      total += main;
      if (!(sideband > 0)) continue;
      for (const double side : {-sideband, sideband}) {
        total += std::min(main, lines.at(h * order * stretch + side));
      }
    }
    return total;
  }
};

struct FoundBlows {
  double stretch = 1;
  double sum = 0;
  double excess = 0;  // over the median of the decoys
  double p_value = 1;
  double smallest_visible = not_known;
};

double step_of(const BlowComb& comb, const BlowLines& lines) {
  return 0.5 * lines.resolution() / (harmonics * comb.order);
}

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
  const int tries = static_cast<int>(std::ceil(smear / step));
  double best = stretch, highest = 0;
  for (int t = -tries; t <= tries; ++t) {
    const double at = stretch * (1 + t * step);
    double sum = 0;
    for (int h = 1; h <= harmonics; ++h) sum += lines.exactly_at(h * comb.order * at);
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
    for (int h = 1; h <= harmonics; ++h) {
      const auto line = static_cast<Index>(std::lround(h * comb.order / channel.resolution));
      if (line >= channel.lines.power.size()) continue;
      const double depth = swing * of_mean_power[static_cast<std::size_t>(h - 1)];
      const double m = channel.lines.floor_lines[line];
      const double over = 1 + depth * depth / channel.lines.floor[line];
      sum += lines.weight(c) * m * (std::log1p(over / m) - std::log1p(1 / m));
    }
  }
  return sum;
}

// All that one part explains: more harmonics than are asked for, and two sidebands to each side.
void take_family(const BlowComb& comb, double stretch, BlowLines& lines) {
  for (int h = 1; h <= 3 * harmonics; ++h) {
    const double main = h * comb.order * stretch;
    for (int m = -2; m <= 2; ++m) {
      if (m == 0 || comb.sideband > 0) lines.take(main + m * comb.sideband);
    }
  }
  lines.spread();
}

class BlowSearch {
 public:
  BlowSearch(const std::vector<ResidualEnvelope>& channels, const Kinematics& kinematics)
      : channels_(channels), k_(kinematics) {}

  FoundBlows operator()(const BlowComb& comb, const BlowLines& lines, double centre,
                        double reach) const {
    FoundBlows best = search(comb, lines, centre, reach);
    // A bad race has so many lines that its decoys would meet some of them.
    best.stretch = refined(comb, lines, best.stretch);
    BlowLines others = lines;
    take_family(comb, best.stretch, others);
    const Eigen::VectorXd decoys = decoys_of(comb, others, reach);
    // Without its first line the others are another part's.
    if (lines.hears(comb.order * best.stretch)) best.p_value = decoy_p_value(best.sum, decoys);
    best.excess = best.sum - median({decoys.begin(), decoys.end()});
    const Eigen::VectorXd single = decoys_of(comb, others, 0);
    const double asked = visible_sum(decoys) - single.mean();
    best.smallest_visible = severity_reaching(
        asked, [&](double severity) { return expected_of(comb, lines, channels_, k_, severity); });
    return best;
  }

 private:
  const std::vector<ResidualEnvelope>& channels_;
  const Kinematics& k_;
};

// Mean square of a train of blows `order` times per turn, at most all that is left. The lines of a
// train, that far apart, are in phase; those of noise are not, and their products cancel.
double blows2(const ResidualEnvelope& channel, double order) {
  const double at = order / channel.resolution;
  const auto line = static_cast<Index>(std::lround(at));
  const auto reach = static_cast<Index>(std::ceil(1 + smear * at));
  const Index n = channel.residual.size();
  double sum = 0;
  for (Index apart = std::max<Index>(3, line - reach); apart <= line + reach; ++apart) {
    if (apart >= n) break;
    const auto low = channel.residual.head(n - apart);
    const auto high = channel.residual.tail(n - apart);
    const double together = std::norm(std::complex<double>(low.dot(high)));
    const double by_noise = low.cwiseAbs2().dot(high.cwiseAbs2());
    sum += together - by_noise;
  }
  const double both_left = channel.left * channel.left;
  return std::min(std::sqrt(std::max(0.0, sum)) / both_left / of_mean_power.front(),
                  channel.residual2 / channel.left);
}

// Squared depth of such blows in each channel; NaN where it has no envelope.
std::vector<double> depths2_of(const std::vector<ResidualEnvelope>& channels,
                               const Kinematics& kinematics, double order) {
  std::vector<double> depths2;
  for (const ResidualEnvelope& channel : channels) {
    depths2.push_back(channel.lines.power.size() == 0
                          ? not_known
                          : 2 * blows2(channel, order) / reference2(channel, kinematics));
  }
  return depths2;
}

double median_of_known(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return median(std::move(values));
}

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
      const double stretch = scores_[b_.inner].order / k_.signatures[b_.inner].order;
      judge_tied(b_.outer, cage_of_inner(stretch) / b_.cage, left);
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
    return median_of_known(depths2_of(channels_, k_, k_.signatures[part].order * blows.stretch));
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
    score.depth2_variance = std::numeric_limits<double>::min();
    score.channel_depths.assign(channels_.size(), 0.0);
    if (blows.p_value >= significant_p) return;
    const std::vector<double> depths2 = depths2_of(channels_, k_, score.order);
    for (std::size_t c = 0; c < depths2.size(); ++c) {
      if (!std::isnan(depths2[c])) score.channel_depths[c] = std::sqrt(depths2[c]);
    }
    score.depth = std::sqrt(median_of_known(depths2));
    std::vector<double> amplitudes;
    for (std::size_t c = 0; c < depths2.size(); ++c) {
      amplitudes.push_back(std::sqrt(depths2[c] * reference2(channels_[c], k_)));
    }
    score.amplitude = median_of_known(std::move(amplitudes));
    score.channel = static_cast<int>(std::ranges::max_element(score.channel_depths) -
                                     score.channel_depths.begin());
    for (int h = 1; h <= harmonics; ++h) {
      score.line_orders.push_back(h * score.order);
      score.line_depths.push_back(score.depth / h);
    }
  }

  const RollingBearing& b_;
  const std::vector<ResidualEnvelope>& channels_;
  const Kinematics& k_;
  std::vector<SignatureScore>& scores_;
  BlowSearch found_;
};

// Jitter smears the lines of a part further than slip moves them: what lies near its order, or a
// simple ratio of it, is its own.
bool is_simple_ratio(double ratio) {
  constexpr double near = 0.03;
  for (const int over : {1, 2, 3}) {
    for (const int under : {1, 2, 3}) {
      const double simple = static_cast<double>(over) / under;
      if (std::abs(ratio - simple) < near * simple) return true;
    }
  }
  return false;
}

// A multiple of a shaft's turn, as far as a stated speed places it.
bool is_of_shaft(double spacing, const std::vector<ResidualEnvelope>& channels,
                 const Kinematics& kinematics) {
  const double off = channels.front().order_error;
  return off > 0 && std::ranges::any_of(kinematics.signatures, [&](const Signature& part) {
           return part.shows == Shows::as_turning && is_multiple(spacing, part.order, off);
         });
}

class UnknownBlows {
 public:
  UnknownBlows(const BlowLines& lines, const std::vector<ResidualEnvelope>& channels,
               const Kinematics& kinematics)
      : lines_(lines), channels_(channels), k_(kinematics) {}

  std::vector<UnknownFamily> find() const {
    const double step = 0.5 * lines_.resolution() / harmonics;
    const double highest = lines_.highest_order() / (harmonics + 0.5);
    std::vector<double> roots;
    double best = 0, best_root = 0;
    for (double spacing = lowest_spacing; spacing < highest; spacing += step) {
      roots.push_back(std::cbrt(sum(spacing)));
      if (roots.back() <= best_root) continue;
      best_root = roots.back();
      best = spacing;
    }
    if (roots.size() < 1000) return {};
    const auto tries = static_cast<double>(roots.size());
    const double centre = median(roots);
    for (double& root : roots) root = std::abs(root - centre);
    const double deviation = 1.4826 * median(std::move(roots));
    best = fundamental_of(best);
    UnknownFamily family{.spacing = best, .harmonics = heard_harmonics(best)};
    family.p_value = std::min(
        1.0, tries * 0.5 * std::erfc((best_root - centre) / deviation / std::numbers::sqrt2));
    if (family.p_value > significant_p || family.harmonics < harmonics) return {};
    family.severity = std::sqrt(median_of_known(depths2_of(channels_, k_, best)));
    return {family};
  }

 private:
  static constexpr double lowest_spacing = 0.25;

  double sum(double spacing) const {
    double total = 0;
    for (int h = 1; h <= harmonics; ++h) total += lines_.at(h * spacing);
    return total;
  }

  // The lines of a family are those of half its spacing as well, but for every other; and twice its
  // spacing has every other of them.
  double fundamental_of(double spacing) const {
    for (const int part : {4, 3, 2}) {
      const double lower = spacing / part;
      if (lower > lowest_spacing && lines_.hears(lower) && lines_.hears(3 * lower)) return lower;
    }
    for (const int times : {2, 3}) {
      if (!lines_.hears(spacing) && lines_.hears(times * spacing)) return times * spacing;
    }
    return spacing;
  }

  int heard_harmonics(double spacing) const {
    int heard = 0;
    for (int h = 1; h <= 2 * harmonics; ++h) heard += lines_.hears(h * spacing) ? 1 : 0;
    return heard;
  }

  const BlowLines& lines_;
  const std::vector<ResidualEnvelope>& channels_;
  const Kinematics& k_;
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
  std::vector<UnknownFamily> unknown = UnknownBlows(lines, channels, kinematics).find();
  std::erase_if(unknown, [&](const UnknownFamily& family) {
    return is_of_shaft(family.spacing, channels, kinematics) ||
           std::ranges::any_of(scores, [&](const SignatureScore& score) {
             const auto& part = kinematics.signatures[static_cast<std::size_t>(score.signature)];
             return part.shows == Shows::as_blows && score.p_value < significant_p &&
                    is_simple_ratio(family.spacing / score.order);
           });
  });
  return unknown;
}

}  // namespace rvbench::analysis
