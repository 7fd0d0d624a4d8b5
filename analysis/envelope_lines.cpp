#include "analysis/envelope_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/hilbert.hpp"
#include "analysis/order/synchronous_average.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double smeared = 5;  // power over floor: five noise lines in a thousand reach it

// Even angle steps fine enough for all the envelope's bandwidth, rate/4 at the most.
int samples_per_turn(double rate_Hz, double speed_Hz) {
  int samples = 32;
  while (samples < 1024 && samples * speed_Hz < rate_Hz / 2) samples *= 2;
  return samples;
}

// The line nearest to `order`; −1 where the spectrum or the carrier ends.
Eigen::Index line_at(const EnvelopeSpectra& envelope, double order) {
  const auto line = static_cast<Eigen::Index>(std::lround(order / envelope.whole.resolution));
  const bool inside =
      line >= 2 && line < envelope.whole.amplitude.size() - 1 && order < envelope.highest_order;
  return inside ? line : -1;
}

struct Sums {
  double statistic = 0;
  double excess = 0;  // power above the floor
  int lines = 0;
  double floor_lines = 0;        // where the floor is known least
  std::vector<double> ratios;    // of each line: power over what it must exceed
  std::vector<double> excesses;  // of each line

  void clear(std::size_t size) {
    statistic = excess = 0;
    lines = 0;
    floor_lines = std::numeric_limits<double>::max();
    ratios.assign(size, 0.0);
    excesses.assign(size, 0.0);
  }
};

// The lines of one signature in one envelope.
class Family {
 public:
  Family(const EnvelopeSpectra& envelope, const Signature& signature,
         const std::vector<SignatureLine>& lines)
      : envelope_(envelope),
        signature_(signature),
        lines_(lines),
        rolls_(signature.slip > 0),
        floor_(rolls_ ? envelope.unlocked : envelope.lines) {}

  // @param taken  lines of the spectrum that another family explains
  FamilyScore score(const std::set<Eigen::Index>& taken) const {
    FamilyScore score;
    score.line_depths.resize(lines_.size());
    // Orders are tried so densely that the highest line moves by half a line from try to try.
    double highest = 0;
    for (const SignatureLine& line : lines_) highest = std::max(highest, line.order);
    const double reach = std::max(signature_.slip, signature_.tolerance);
    const auto tries =
        static_cast<int>(std::ceil(2 * reach * highest / envelope_.whole.resolution));
    double best_stretch = 1;
    Sums best, sums;
    sum_lines(1, taken, best);
    for (int i = -tries; i <= tries && tries > 0; ++i) {
      const double stretch = 1 + reach * i / tries;
      sum_lines(stretch, taken, sums);
      if (sums.statistic <= best.statistic) continue;
      std::swap(best, sums);
      best_stretch = stretch;
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      score.line_depths[i] = std::sqrt(std::max(best.excesses[i], 0.0)) / envelope_.mean;
    }
    score.order = signature_.order * best_stretch;
    score.statistic = best.statistic;
    score.p_value =
        std::min(1.0, line_p_value(best.statistic, best.lines, best.floor_lines) * (2 * tries + 1));
    score.depth = std::sqrt(std::max(best.excess, 0.0)) / envelope_.mean;
    return score;
  }

  // Adds the lines of a score and all higher harmonics, each as wide as slip has smeared it.
  void take(const FamilyScore& score, std::set<Eigen::Index>& taken) const {
    const auto take_line = [&](double order) {
      const Eigen::Index at = line_at(envelope_, order);
      if (at < 0) return;
      const auto widest = std::max<Eigen::Index>(2, static_cast<Eigen::Index>(0.02 * double(at)));
      for (const int side : {-1, 1}) {
        for (Eigen::Index away = 0; away <= widest; ++away) {
          const Eigen::Index line = at + side * away;
          if (line < 0 || line >= floor_.power.size()) break;
          if (away > 2 && floor_.power[line] < smeared * floor_.floor[line]) break;
          taken.insert(line);
        }
      }
    };
    for (const SignatureLine& line : lines_) {
      take_line(line.order * score.order / signature_.order);
    }
    for (double order = score.order; order < envelope_.highest_order; order += score.order) {
      take_line(order);
    }
  }

 private:
  void sum_lines(double stretch, const std::set<Eigen::Index>& taken, Sums& sums) const {
    sums.clear(lines_.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Eigen::Index line = line_at(envelope_, lines_[i].order * stretch);
      if (line < 0 || (rolls_ && floor_.is_locked(line)) || taken.contains(line)) continue;
      const double base = base_of(lines_[i], line);
      sums.ratios[i] = floor_.power[line] / base;
      sums.excesses[i] = floor_.power[line] - base;
      if (rolls_ && lines_[i].sideband_of >= 0) {
        const auto harmonic = static_cast<std::size_t>(lines_[i].sideband_of);
        sums.ratios[i] = std::min(sums.ratios[i], sums.ratios[harmonic]);
        sums.excesses[i] = std::min(sums.excesses[i], sums.excesses[harmonic]);
      }
      sums.statistic += sums.ratios[i];
      sums.excess += sums.excesses[i];
      ++sums.lines;
      sums.floor_lines = std::min(sums.floor_lines, floor_.floor_lines[line]);
    }
  }

  // What a line must exceed to speak for this family.
  double base_of(const SignatureLine& wanted, Eigen::Index line) const {
    double base = floor_.floor[line];
    for (const double rival : wanted.rivals) {
      const Eigen::Index other = line_at(envelope_, rival);
      if (other >= 0) base = std::max(base, floor_.power[other]);
    }
    return base;
  }

  const EnvelopeSpectra& envelope_;
  const Signature& signature_;
  const std::vector<SignatureLine>& lines_;
  bool rolls_;
  const LineFloor& floor_;
};

}  // namespace

EnvelopeSpectra envelope_spectra(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                 double start_s, const ShaftAngle& angle, double period_turns) {
  EnvelopeSpectra result;
  const int per_turn = samples_per_turn(rate_Hz, angle.mean_speed_Hz());
  const Eigen::VectorXd over_angle =
      angle.resample(envelope(x), rate_Hz, start_s, period_turns, per_turn);
  if (over_angle.size() < 16) return result;

  result.mean = over_angle.mean();
  result.highest_order = 0.5 * crossing_frequency(x, rate_Hz) / angle.mean_speed_Hz();
  result.periods = std::round(static_cast<double>(over_angle.size()) / per_turn / period_turns);
  const auto periods = static_cast<Eigen::Index>(result.periods);
  const Eigen::VectorXd swing = over_angle.array() - result.mean;
  result.whole = amplitude_spectrum(swing, per_turn, Window::hann);
  result.lines = line_floor(result.whole, periods);
  if (periods >= 2 && over_angle.size() % periods == 0) {
    result.unlocked =
        line_floor(amplitude_spectrum(without_average(over_angle, over_angle.size() / periods),
                                      per_turn, Window::hann),
                   periods);
  } else {
    result.unlocked = result.lines;
  }
  return result;
}

std::vector<FamilyScore> score_families(const EnvelopeSpectra& envelope,
                                        const std::vector<Signature>& signatures,
                                        const std::vector<std::vector<SignatureLine>>& lines) {
  std::vector<Family> families;
  std::vector<FamilyScore> scores;
  std::vector<std::size_t> waiting;  // those that roll, and have not explained their lines yet
  std::set<Eigen::Index> taken;
  for (std::size_t i = 0; i < signatures.size(); ++i) {
    scores.push_back(families.emplace_back(envelope, signatures[i], lines[i]).score(taken));
    if (signatures[i].slip > 0) waiting.push_back(i);
  }
  while (waiting.size() > 1) {
    const auto deepest = std::max_element(
        waiting.begin(), waiting.end(),
        [&](std::size_t a, std::size_t b) { return scores[a].depth < scores[b].depth; });
    families[*deepest].take(scores[*deepest], taken);
    waiting.erase(deepest);
    for (const std::size_t i : waiting) scores[i] = families[i].score(taken);
  }
  return scores;
}

}  // namespace rvbench::analysis
