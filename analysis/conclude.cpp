#include <algorithm>
#include <cmath>

#include "analysis/diagnosis.hpp"
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
  std::vector<double> p_values;               // of all resolvable points
};

Evidence gather(const std::vector<Examination>& points, std::size_t signature) {
  Evidence evidence;
  for (const Examination& point : points) {
    if (!point.resolvable) continue;
    const SignatureScore& score = point.scores[signature];
    evidence.p_values.push_back(score.p_value);
    if (score.p_value < significant_p && score.depth > 0) {
      evidence.shown_by.push_back(&point);
      evidence.scores.push_back(&score);
    }
  }
  return evidence;
}

double median_depth(const Evidence& evidence) {
  std::vector<double> depths;
  for (const SignatureScore* score : evidence.scores) depths.push_back(score->depth);
  return median(std::move(depths));
}

void list_lines(const Evidence& evidence, Finding& finding) {
  const SignatureScore* deepest = *std::max_element(
      evidence.scores.begin(), evidence.scores.end(),
      [](const SignatureScore* a, const SignatureScore* b) { return a->depth < b->depth; });
  std::vector<std::size_t> by_depth(deepest->line_orders.size());
  for (std::size_t i = 0; i < by_depth.size(); ++i) by_depth[i] = i;
  std::stable_sort(by_depth.begin(), by_depth.end(), [&](std::size_t a, std::size_t b) {
    return deepest->line_depths[a] > deepest->line_depths[b];
  });
  for (const std::size_t i : by_depth) {
    if (finding.line_orders.size() == lines_listed || deepest->line_depths[i] == 0) break;
    finding.line_orders.push_back(deepest->line_orders[i]);
    finding.line_depths.push_back(deepest->line_depths[i]);
  }
}

Finding make_finding(const Signature& signature, const Evidence& evidence, double tests) {
  Finding f;
  f.component = signature.component;
  f.mechanism = signature.mechanism;
  f.table4_item = signature.table4_item;
  f.order = evidence.scores.front()->order;
  f.frequency_Hz = f.order * evidence.shown_by.front()->speed_rpm / 60;
  for (const Examination* point : evidence.shown_by) f.points.push_back(point->source);
  for (const SignatureScore* score : evidence.scores) {
    if (std::find(f.imfs.begin(), f.imfs.end(), score->imf) == f.imfs.end()) {
      f.imfs.push_back(score->imf);
    }
    f.statistic = std::max(f.statistic, score->statistic);
  }
  std::sort(f.imfs.begin(), f.imfs.end());
  f.p_value = std::min(1.0, combined_p_value(evidence.p_values) * tests);
  f.severity = median_depth(evidence);
  f.limit = signature.depth_limit;
  f.advice = signature.advice;
  list_lines(evidence, f);
  return f;
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

Diagnosis conclude(const std::vector<Examination>& points, const Kinematics& kinematics) {
  Diagnosis d;
  for (const Examination& point : points) {
    d.resolvable = d.resolvable || point.resolvable;
    d.quality.insert(d.quality.end(), point.quality.begin(), point.quality.end());
  }
  const auto tests = static_cast<double>(kinematics.signatures.size());
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    const Evidence evidence = gather(points, s);
    // A bad part shows in most of what was measured, not in one record of many.
    if (evidence.scores.empty() || 2 * evidence.scores.size() < evidence.p_values.size()) continue;
    Finding f = make_finding(kinematics.signatures[s], evidence, tests);
    if (f.p_value >= significant_p) continue;
    (f.severity > f.limit ? d.findings : d.below_limit).push_back(std::move(f));
  }
  const auto graver = [](const Finding& a, const Finding& b) { return excess(a) > excess(b); };
  std::sort(d.findings.begin(), d.findings.end(), graver);
  std::sort(d.below_limit.begin(), d.below_limit.end(), graver);
  double total = 0;
  for (const Finding& f : d.findings) total += excess(f);
  for (Finding& f : d.findings) f.confidence = excess(f) / total;
  d.unexplained = unexplained_families(points, kinematics);
  return d;
}

}  // namespace rvbench::analysis
