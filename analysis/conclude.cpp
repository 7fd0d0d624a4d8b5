#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/carrying_lines.hpp"
#include "analysis/evidence/consequence.hpp"
#include "analysis/evidence/equal_explanations.hpp"
#include "analysis/evidence/growth_law.hpp"
#include "analysis/evidence/lines_by_depth.hpp"
#include "analysis/evidence/record_resolution.hpp"
#include "analysis/evidence/severity.hpp"
#include "analysis/statistics.hpp"
#include "analysis/unexplained_families.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t lines_listed = 8;  // evidence lines shown per finding
constexpr double fits_at = 0.05;         // p of a growth that contradicts its mechanism below it

// Points that show a signature, and how.
struct Evidence {
  std::vector<const Examination*> shown_by;
  std::vector<const SignatureScore*> scores;  // of shown_by
  std::vector<const SignatureScore*> all;     // of all resolvable points that could read it

  // A bad part shows in half of what was measured, or in more than one record even if all that
  // were looked at, for all parts, are paid for: at high load, say. One record of many is none.
  bool shows(double tests) const {
    if (2 * scores.size() >= all.size()) return !scores.empty();
    const double paid = significant_p / (tests * static_cast<double>(all.size()));
    return std::ranges::count_if(
               scores, [&](const SignatureScore* score) { return score->p_value < paid; }) > 1;
  }

  // Index of the point that shows it deepest.
  std::size_t deepest() const {
    const auto depth = [](const SignatureScore* score) { return score->depth; };
    return static_cast<std::size_t>(std::ranges::max_element(scores, {}, depth) - scores.begin());
  }
};

Evidence gather(const std::vector<Examination>& points, std::size_t signature) {
  Evidence evidence;
  for (const Examination& point : points) {
    if (!point.resolvable) continue;
    const SignatureScore& score = point.scores[signature];
    if (!score.is_read()) continue;
    evidence.all.push_back(&score);
    if (score.p_value < significant_p && score.depth > 0) {
      evidence.shown_by.push_back(&point);
      evidence.scores.push_back(&score);
    }
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

std::string name_of(const Signature& s) {
  return fmt::format("{}: {} at order {:.4g}", s.component, s.mechanism, s.order);
}

// Gears of one shaft have all their lines in common, and the first of them speaks for all.
std::optional<std::size_t> spoken_for_by(std::size_t signature, const Kinematics& kinematics) {
  constexpr double near = 1e-6;
  const Signature& own = kinematics.signatures[signature];
  const std::vector<double> lines = comb_lines(own, own.first_harmonic, 1);
  for (std::size_t s = 0; s < signature; ++s) {
    const Signature& other = kinematics.signatures[s];
    if (holds_all(comb_lines(other, other.first_harmonic, 1), lines, near)) return s;
  }
  return std::nullopt;
}

// What explains the finding as well at the point that shows it deepest, and grows as it does.
std::vector<std::string> rivals_of(const Evidence& evidence, const Growth& load,
                                   const Kinematics& kinematics) {
  const std::size_t deepest = evidence.deepest();
  const double resolution = record_resolution(*evidence.shown_by[deepest], kinematics);
  std::vector<std::string> rivals;
  for (const std::size_t s :
       equal_explanations(*evidence.scores[deepest], kinematics, resolution)) {
    const Signature& rival = kinematics.signatures[s];
    if (p_value_of_growth(load, rival.load_growth) < fits_at) continue;
    rivals.push_back(name_of(rival));
  }
  return rivals;
}

// The hypothesis as far as it goes whether or not a point shows it.
Finding weigh(const Signature& signature, const Evidence& evidence, double tests) {
  Finding f;
  f.component = signature.component;
  f.mechanism = signature.mechanism;
  f.table4_item = signature.table4_item;
  f.order = signature.order;
  f.limit = signature.depth_limit;
  f.advice = signature.advice;
  std::vector<double> p_values;
  for (const SignatureScore* score : evidence.all) {
    p_values.push_back(score->p_value);
    f.log_likelihood_ratio += score->log_likelihood_ratio;
  }
  f.p_value = std::min(1.0, combined_p_value(p_values) * tests);
  for (const Examination* point : evidence.shown_by) f.points.push_back(point->source);
  const bool is_shown = !evidence.scores.empty();
  const Severity severity = is_shown               ? severity_of(evidence.scores)
                            : evidence.all.empty() ? Severity{0, not_known, not_known}
                                                   : Severity{0, 0, depth_bound(evidence.all)};
  f.severity = severity.depth;
  f.severity_low = severity.low;
  f.severity_high = severity.high;
  return f;
}

// What is known of the other is all that is known of it.
void be_spoken_for(Finding& f, const std::vector<Examination>& points, const Kinematics& kinematics,
                   std::size_t speaker) {
  const Signature& other = kinematics.signatures[speaker];
  const Finding known = weigh(other, gather(points, speaker), 1);
  f.severity_low = 0;
  f.severity_high = known.severity_high;
  // What is shown is judged by the other's name, and hides nothing of this one.
  if (!known.points.empty()) f.severity_high = std::min(known.severity_high, f.limit);
  f.cannot_tell_from = {name_of(other)};
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
  list_lines(evidence, f);
  f.growth = growth_law(evidence.shown_by, signature);
  f.growth_p_value = p_value_of_growth(f.growth.load, kinematics.signatures[signature].load_growth);
  f.growth_fits = f.growth_p_value >= fits_at;
  f.cannot_tell_from = rivals_of(evidence, f.growth.load, kinematics);
}

// Severity over its limit, less what its growth speaks against it: at most nine tenths, as the
// ranges are rules of thumb. Finite where the limit allows nothing at all.
double weight(const Finding& finding) {
  const double odds = std::max(odds_at_most(finding.growth_p_value), 0.1);
  return odds * finding.severity / std::max(finding.limit, 1e-6);
}

// A hypothesis that shows.
struct Shown {
  std::size_t signature;
  Finding finding;
  Evidence evidence;
  double weight;
  bool is_cause = false;  // of one that by itself would weigh more

  bool is_bad() const { return finding.severity > finding.limit; }
};

// Whether the other makes all its lines, where it is deepest.
bool follows(const Shown& lesser, const Shown& graver, const Kinematics& kinematics) {
  if (lesser.finding.component == graver.finding.component) return false;
  const std::size_t deepest = lesser.evidence.deepest();
  const Examination& point = *lesser.evidence.shown_by[deepest];
  return may_follow_from(*lesser.evidence.scores[deepest], point.scores[graver.signature],
                         kinematics, record_resolution(point, kinematics));
}

// A spall that turns through the load makes its shaft's lines, too; the shaft makes none of the
// spall's, which slip. So both together speak for the spall. Of gears neither could be said: an
// eccentric shaft makes sidebands of their meshes.
void raise_causes(std::vector<Shown>& shown, const Kinematics& kinematics) {
  for (Shown& cause : shown) {
    if (!(kinematics.signatures[cause.signature].slip > 0) || !cause.is_bad()) continue;
    for (const Shown& other : shown) {
      if (other.weight <= cause.weight || !follows(other, cause, kinematics)) continue;
      cause.weight = other.weight;
      cause.is_cause = true;
    }
  }
}

bool is_graver(const Shown& a, const Shown& b) {
  return a.weight != b.weight ? a.weight > b.weight : a.is_cause && !b.is_cause;
}

// Names the gravest of those before it that it may follow from.
void relate(std::vector<Shown>& shown, const Kinematics& kinematics) {
  for (std::size_t i = 1; i < shown.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!follows(shown[i], shown[j], kinematics)) continue;
      const Finding& graver = shown[j].finding;
      shown[i].finding.may_follow_from = graver.component + ": " + graver.mechanism;
      break;
    }
  }
}

}  // namespace

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
  std::vector<Shown> shown;
  const auto tests = static_cast<double>(kinematics.signatures.size());
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    Evidence evidence = gather(points, s);
    Finding f = weigh(kinematics.signatures[s], evidence, tests);
    if (evidence.all.empty()) {
      if (const auto speaker = spoken_for_by(s, kinematics)) {
        be_spoken_for(f, points, kinematics, *speaker);
      }
    }
    if (!evidence.shows(tests) || f.p_value >= significant_p) {
      d.not_shown.push_back(std::move(f));
      continue;
    }
    describe(f, evidence, kinematics, s);
    const double own = weight(f);
    shown.push_back({s, std::move(f), std::move(evidence), own});
  }
  raise_causes(shown, kinematics);
  std::ranges::stable_sort(shown, is_graver);
  relate(shown, kinematics);
  double total = 0;
  for (const Shown& s : shown) total += s.is_bad() ? s.weight : 0;
  for (Shown& s : shown) {
    const bool is_bad = s.is_bad();
    if (is_bad) s.finding.confidence = s.weight / total;
    (is_bad ? d.findings : d.below_limit).push_back(std::move(s.finding));
  }
  std::ranges::sort(d.not_shown, {}, &Finding::p_value);
  d.unexplained = unexplained_families(points, kinematics);
  return d;
}

}  // namespace rvbench::analysis
