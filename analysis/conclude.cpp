#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/equal_explanations.hpp"
#include "analysis/evidence/growth_law.hpp"
#include "analysis/evidence/lines_by_depth.hpp"
#include "analysis/evidence/severity.hpp"
#include "analysis/spectral_lines.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t lines_listed = 8;  // evidence lines shown per finding
constexpr std::size_t families_listed = 12;

// Points that show a signature, and how.
struct Evidence {
  std::vector<const Examination*> shown_by;
  std::vector<const SignatureScore*> scores;  // of shown_by
  std::vector<const SignatureScore*> all;     // of all resolvable points

  // A bad part shows in most of what was measured, not in one record of many.
  bool shows() const { return !scores.empty() && 2 * scores.size() >= all.size(); }

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

// What explains the finding as well at the point that shows it deepest.
std::vector<std::string> rivals_of(const Evidence& evidence, const Kinematics& kinematics) {
  const std::size_t deepest = evidence.deepest();
  const double turns = evidence.shown_by[deepest]->periods * kinematics.period_turns;
  std::vector<std::string> rivals;
  for (const std::size_t s : equal_explanations(*evidence.scores[deepest], kinematics, 1 / turns)) {
    const Signature& rival = kinematics.signatures[s];
    rivals.push_back(
        fmt::format("{}: {} at order {:.4g}", rival.component, rival.mechanism, rival.order));
  }
  return rivals;
}

// Outside its interval and outside what the mechanism allows.
bool fits(const Growth& load, const Signature& signature) {
  return !std::isfinite(load.exponent) || !std::isfinite(load.error) ||
         (load.exponent + load.error >= signature.least_load_exponent &&
          load.exponent - load.error <= signature.most_load_exponent);
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
  if (evidence.all.empty()) return f;
  const Severity severity = severity_of(evidence.scores.empty() ? evidence.all : evidence.scores);
  f.severity = severity.depth;
  f.severity_low = severity.low;
  f.severity_high = severity.high;
  return f;
}

// Adds where and how the points show it.
void describe(Finding& f, const Evidence& evidence, const Kinematics& kinematics,
              std::size_t signature) {
  f.order = evidence.scores.front()->order;
  f.frequency_Hz = f.order * evidence.shown_by.front()->speed_rpm / 60;
  for (const SignatureScore* score : evidence.scores) {
    if (std::find(f.imfs.begin(), f.imfs.end(), score->imf) == f.imfs.end()) {
      f.imfs.push_back(score->imf);
    }
  }
  std::sort(f.imfs.begin(), f.imfs.end());
  list_lines(evidence, f);
  f.growth = growth_law(evidence.shown_by, signature);
  f.growth_fits = fits(f.growth.load, kinematics.signatures[signature]);
  f.cannot_tell_from = rivals_of(evidence, kinematics);
}

// Severity over its limit; finite where the limit allows nothing at all.
double excess(const Finding& finding) { return finding.severity / std::max(finding.limit, 1e-6); }

// What no kinematics accounts for, over all channels and points.
std::vector<SpectralLine> unexplained_families(const std::vector<Examination>& points,
                                               const Kinematics& kinematics) {
  std::vector<SpectralLine> lines;
  for (const Examination& point : points) {
    for (const ChannelExamination& channel : point.channels) {
      for (const SpectralLine& line : channel.lines) {
        if (!line.meaning.empty()) continue;
        const auto same = std::find_if(lines.begin(), lines.end(), [&](const SpectralLine& other) {
          return std::abs(other.order - line.order) < 1e-3 * line.order;
        });
        if (same == lines.end()) {
          lines.push_back(line);
        } else if (line.amplitude > same->amplitude) {
          *same = line;
        }
      }
    }
  }
  std::sort(lines.begin(), lines.end(),
            [](const SpectralLine& a, const SpectralLine& b) { return a.amplitude > b.amplitude; });
  if (lines.size() > 200) lines.resize(200);
  std::vector<SpectralLine> result = families(std::move(lines), kinematics);
  if (result.size() > families_listed) result.resize(families_listed);
  return result;
}

}  // namespace

const Finding* Diagnosis::second() const {
  if (findings.empty()) return nullptr;
  for (const auto* hypotheses : {&findings, &below_limit, &not_shown}) {
    for (const Finding& hypothesis : *hypotheses) {
      if (hypothesis.component != findings.front().component) return &hypothesis;
    }
  }
  return nullptr;
}

Diagnosis conclude(const std::vector<Examination>& points, const Kinematics& kinematics) {
  Diagnosis d;
  for (const Examination& point : points) {
    d.resolvable = d.resolvable || point.resolvable;
    d.quality.insert(d.quality.end(), point.quality.begin(), point.quality.end());
  }
  const auto tests = static_cast<double>(kinematics.signatures.size());
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    const Evidence evidence = gather(points, s);
    Finding f = weigh(kinematics.signatures[s], evidence, tests);
    if (!evidence.shows() || f.p_value >= significant_p) {
      d.not_shown.push_back(std::move(f));
      continue;
    }
    describe(f, evidence, kinematics, s);
    (f.severity > f.limit ? d.findings : d.below_limit).push_back(std::move(f));
  }
  const auto graver = [](const Finding& a, const Finding& b) { return excess(a) > excess(b); };
  std::sort(d.findings.begin(), d.findings.end(), graver);
  std::sort(d.below_limit.begin(), d.below_limit.end(), graver);
  std::sort(d.not_shown.begin(), d.not_shown.end(),
            [](const Finding& a, const Finding& b) { return a.p_value < b.p_value; });
  double total = 0;
  for (const Finding& f : d.findings) total += excess(f);
  for (Finding& f : d.findings) f.confidence = excess(f) / total;
  d.unexplained = unexplained_families(points, kinematics);
  return d;
}

}  // namespace rvbench::analysis
