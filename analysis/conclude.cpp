#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/growth_law.hpp"
#include "analysis/evidence/lines_by_depth.hpp"
#include "analysis/evidence/related_parts.hpp"
#include "analysis/evidence/same_speed.hpp"
#include "analysis/evidence/severity.hpp"
#include "analysis/evidence/unknown_families.hpp"
#include "analysis/statistics.hpp"
#include "analysis/unexplained_families.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t lines_listed = 8;  // evidence lines shown per finding
// Standard deviations. One draw of random phases in seven lies above the first, and one in a
// hundred above the second.
constexpr double scattered_below = 1;
constexpr double aligned_at = 3;
constexpr double fits_at = 0.05;  // p of a growth that contradicts its mechanism below it

// Damage is about the same share of a mesh at every speed. A tone that stands still in Hz meets a
// part's lines at one speed alone. It is a tone if records of two other speeds at least neither
// show nor may hide a tenth of it.
bool is_tone(const SignatureScore& shown, const Examination& point,
             const std::vector<const Examination*>& read) {
  constexpr double far_above = 10;
  std::vector<double> other_speeds_rpm;
  for (const Examination* other : read) {
    const double speed_rpm = other->speed_rpm;
    if (is_same_speed(speed_rpm, point.speed_rpm)) continue;
    const SignatureScore& there = other->scores[static_cast<std::size_t>(shown.signature)];
    const bool is_far_below =
        far_above * there.depth < shown.depth && far_above * there.smallest_visible < shown.depth;
    if (!is_far_below) return false;
    if (std::ranges::none_of(other_speeds_rpm,
                             [&](double known) { return is_same_speed(known, speed_rpm); })) {
      other_speeds_rpm.push_back(speed_rpm);
    }
  }
  return other_speeds_rpm.size() >= 2;
}

// Points that speak for a signature, and how.
struct Evidence {
  std::vector<const Examination*> shown_by;
  std::vector<const SignatureScore*> scores;  // of shown_by
  std::vector<const SignatureScore*> all;     // of all resolvable points that could read it

  // Half of what was measured speaks for a bad part, or more than one record shows it even if all
  // that were looked at, for all parts, are paid for: at high load, say. One record of many is
  // none.
  bool shows(double tests) const {
    if (2 * scores.size() >= all.size()) return !scores.empty();
    return std::ranges::count_if(scores, [&](const SignatureScore* score) {
             return score->p_value < paid(tests);
           }) > 1;
  }

  // Deepest in a record that shows it all the same; 0 if none does.
  double surely_shown(double tests) const {
    double depth = 0;
    for (const SignatureScore* score : scores) {
      if (score->p_value < paid(tests)) depth = std::max(depth, score->depth);
    }
    return depth;
  }

  double paid(double tests) const {
    return significant_p / (tests * static_cast<double>(all.size()));
  }

  // Index of the point that shows it deepest.
  std::size_t deepest() const {
    const auto depth = [](const SignatureScore* score) { return score->depth; };
    return static_cast<std::size_t>(std::ranges::max_element(scores, {}, depth) - scores.begin());
  }
};

Evidence gather(const std::vector<Examination>& points, std::size_t signature) {
  Evidence evidence;
  // Also where its median channel has no more than noise: else only depths that noise raised count.
  const auto shows = [](const SignatureScore& score) { return score.p_value < plausible_p; };
  std::vector<const Examination*> read;
  std::size_t by_noise = 0;
  for (const Examination& point : points) {
    const SignatureScore& score = point.scores[signature];
    if (!point.resolvable || !score.is_read()) continue;
    read.push_back(&point);
    evidence.all.push_back(&score);
    by_noise += shows(score) && score.by_noise ? 1 : 0;
  }
  // Noise that swings at a few points only is no damage: a tone passes a resonance there.
  const bool noise_counts = 2 * by_noise >= evidence.all.size();
  for (std::size_t i = 0; i < read.size(); ++i) {
    const SignatureScore& score = *evidence.all[i];
    if (!shows(score) || (score.by_noise && !noise_counts)) continue;
    if (is_tone(score, *read[i], read)) continue;
    evidence.shown_by.push_back(read[i]);
    evidence.scores.push_back(&score);
  }
  return evidence;
}

void list_lines(const Evidence& evidence, Finding& finding) {
  const SignatureScore& deepest = *evidence.scores[evidence.deepest()];
  for (const std::size_t i : lines_by_depth(deepest)) {
    if (finding.line_orders.size() == lines_listed || deepest.line_depths[i] == 0) break;
    finding.line_orders.push_back(deepest.line_orders[i]);
    finding.line_depths.push_back(deepest.line_depths[i]);
  }
}

// NaN where a channel's unit is not known, or the part shows in the noise alone.
double amplitude_m_s2(const Evidence& evidence) {
  std::vector<double> amplitudes;
  for (std::size_t i = 0; i < evidence.scores.size(); ++i) {
    const std::vector<ChannelExamination>& channels = evidence.shown_by[i]->channels;
    const bool is_si = std::ranges::all_of(
        channels, [](const ChannelExamination& channel) { return channel.unit == "m/s²"; });
    const double amplitude = evidence.scores[i]->amplitude;
    if (is_si && !std::isnan(amplitude)) amplitudes.push_back(amplitude);
  }
  return amplitudes.empty() ? not_known : median(std::move(amplitudes));
}

// A part must show in half of the points, so this is the least severity that half of them would
// have shown. NaN where no point could read a line of the part.
double smallest_visible(const std::vector<const SignatureScore*>& scores) {
  std::vector<double> visible;
  for (const SignatureScore* score : scores) {
    if (!std::isnan(score->smallest_visible)) visible.push_back(score->smallest_visible);
  }
  if (visible.empty()) return not_known;
  const auto middle = visible.begin() + (std::ssize(visible) - 1) / 2;
  std::ranges::nth_element(visible, middle);
  return *middle;
}

double in_phase(const std::vector<const SignatureScore*>& scores) {
  double sum = 0;
  int points = 0;
  for (const SignatureScore* score : scores) {
    if (std::isnan(score->in_phase)) continue;
    sum += score->in_phase;
    ++points;
  }
  return points > 0 ? sum / points : not_known;
}

double limit_of_shape(const Signature& part, double in_phase, bool by_noise) {
  if (by_noise) return std::min(part.depth_limit, part.noise_limit);
  if (in_phase >= aligned_at) return std::min(part.depth_limit, part.aligned_limit);
  const bool is_scattered = in_phase < scattered_below;
  return is_scattered ? std::max(part.depth_limit, part.scatter_limit) : part.depth_limit;
}

// Noise lifts a learnt limit to what it hides, but not over a severity that is surely above it.
// A severity that is not known lifts no limit.
double limit_of(const Signature& part, const Finding& f, bool by_noise) {
  const double limit = limit_of_shape(part, f.in_phase, by_noise);
  if (f.severity_low > limit) return limit;
  return std::max(limit, std::min(f.smallest_visible, part.limit_in_noise));
}

// Median of the points of each speed, and of these the least.
double least_of_speeds(const Evidence& evidence) {
  double least = std::numeric_limits<double>::infinity();
  for (const Examination* of_speed : evidence.shown_by) {
    std::vector<double> depths;
    for (std::size_t i = 0; i < evidence.scores.size(); ++i) {
      if (is_same_speed(evidence.shown_by[i]->speed_rpm, of_speed->speed_rpm)) {
        depths.push_back(evidence.scores[i]->depth);
      }
    }
    least = std::min(least, median(std::move(depths)));
  }
  return least;
}

// The hypothesis as far as it goes whether or not a point shows it.
Finding weigh(const Signature& signature, const Evidence& evidence, double tests) {
  Finding f;
  f.component = signature.component;
  f.mechanism = signature.mechanism;
  f.table4_item = signature.table4_item;
  f.order = signature.order;
  const bool by_noise =
      !evidence.scores.empty() && std::ranges::all_of(evidence.scores, &SignatureScore::by_noise);
  f.in_phase = in_phase(evidence.scores);
  f.smallest_visible = smallest_visible(evidence.all);
  f.advice = signature.advice;
  std::vector<double> p_values;
  for (const SignatureScore* score : evidence.all) {
    p_values.push_back(score->p_value);
    f.log_likelihood_ratio += score->log_likelihood_ratio;
  }
  f.p_value = std::min(1.0, combined_p_value(p_values) * tests);
  for (const Examination* point : evidence.shown_by) f.points.push_back(point->source);
  Severity severity{0, 0, f.smallest_visible};
  if (!evidence.scores.empty()) severity = severity_of(evidence.scores);
  if (signature.at_every_speed && severity.depth > 0) {
    severity.depth = least_of_speeds(evidence);
    severity.low = std::min(severity.low, severity.depth);
  }
  if (severity.depth == 0) {
    f.points.clear();  // what they show is no deeper than their noise
    severity.high = f.smallest_visible;
  }
  f.severity = severity.depth;
  f.severity_low = severity.low;
  f.severity_high = severity.high;
  f.limit = limit_of(signature, f, by_noise);
  f.over_sound = (f.severity - signature.sound_median) / signature.sound_scatter;
  return f;
}

// Adds where and how the points show it.
void describe(Finding& f, const Evidence& evidence, const Kinematics& kinematics,
              std::size_t signature) {
  f.order = evidence.scores.front()->order;
  f.frequency_Hz = f.order * units::Hz_from_rpm(std::abs(evidence.shown_by.front()->speed_rpm));
  for (const SignatureScore* score : evidence.scores) {
    if (std::find(f.imfs.begin(), f.imfs.end(), score->imf) == f.imfs.end()) {
      f.imfs.push_back(score->imf);
    }
  }
  std::sort(f.imfs.begin(), f.imfs.end());
  f.severity_m_s2 = amplitude_m_s2(evidence);
  list_lines(evidence, f);
  f.growth = growth_law(evidence.shown_by, signature);
  f.growth_p_value = p_value_of_growth(f.growth.load, kinematics.signatures[signature].load_growth);
  f.growth_fits = f.growth_p_value >= fits_at;
}

}  // namespace

bool Finding::may_be(const std::string& part) const {
  return component == part || std::ranges::find(one_of, part) != one_of.end();
}

std::vector<const Finding*> Diagnosis::hypotheses() const {
  std::vector<const Finding*> all;
  for (const auto* list : {&findings, &below_limit, &not_shown}) {
    for (const Finding& hypothesis : *list) all.push_back(&hypothesis);
  }
  return all;
}

const Finding* Diagnosis::second() const {
  if (findings.empty()) return nullptr;
  for (const Finding* hypothesis : hypotheses()) {
    if (hypothesis->component != findings.front().component) return hypothesis;
  }
  return nullptr;
}

Diagnosis conclude(const std::vector<Examination>& points, const Kinematics& kinematics) {
  Diagnosis d;
  for (const Examination& point : points) {
    d.resolvable = d.resolvable || point.resolvable;
    d.quality.insert(d.quality.end(), point.quality.begin(), point.quality.end());
  }
  std::vector<ShownPart> shown;
  const auto tests = static_cast<double>(kinematics.signatures.size());
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    const Evidence evidence = gather(points, s);
    Finding f = weigh(kinematics.signatures[s], evidence, tests);
    if (!evidence.shows(tests) || f.p_value >= significant_p || f.severity == 0) {
      // Too few points show the part. They do not prove that it is within its limit, and do not
      // tell in which phase its lines would be.
      clear_shown(f);
      f.in_phase = not_known;
      f.limit = limit_of(kinematics.signatures[s], f, false);
      f.severity_high = std::max(f.smallest_visible, evidence.surely_shown(tests));
      d.not_shown.push_back(std::move(f));
      continue;
    }
    describe(f, evidence, kinematics, s);
    shown.push_back(shown_part(s, std::move(f)));
  }
  relate_parts(shown, d.not_shown, kinematics);
  double total = 0;
  for (const ShownPart& s : shown) total += s.is_bad() ? s.weight : 0;
  for (ShownPart& s : shown) {
    const bool is_bad = s.is_bad();
    if (is_bad) s.finding.confidence = s.weight / total;
    (is_bad ? d.findings : d.below_limit).push_back(std::move(s.finding));
  }
  std::ranges::sort(d.not_shown, {}, &Finding::p_value);
  d.unexplained = unexplained_families(points, kinematics);
  d.unknown = unknown_families(points, d, kinematics);
  return d;
}

}  // namespace rvbench::analysis
