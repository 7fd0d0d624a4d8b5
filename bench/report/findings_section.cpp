#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/findings_stand.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

using analysis::Finding;
using analysis::SpectralLine;

std::string evidence_of(const Finding& finding, double period_turns) {
  std::string text;
  for (std::size_t i = 0; i < finding.line_orders.size(); ++i) {
    text += fmt::format("{}order {}: depth {:.3f}", i == 0 ? "" : "; ",
                        order_text(finding.line_orders[i], period_turns), finding.line_depths[i]);
  }
  return text.empty() ? "–" : text;
}

std::string imfs_of(const Finding& finding) {
  std::string text;
  for (const int imf : finding.imfs) text += (text.empty() ? "" : ", ") + std::to_string(imf);
  return text.empty() ? "–" : text;
}

// What a hypothesis that is none of the findings was shown by.
std::string shown_in(const Finding& hypothesis, std::size_t points) {
  if (hypothesis.p_value >= analysis::significant_p) return "not shown";
  return fmt::format("in {} of {} points: too few", hypothesis.points.size(), points);
}

// How sure it is of a finding, and what to do about it.
std::string consequence_of(const Finding& finding) {
  return fmt::format(
             "<dt>Confidence</dt><dd>{:.0f} %: this part's share of severity over limit, times how "
             "well its growth fits, among all findings above theirs; a cause counts for no less "
             "than what follows from it</dd>",
             100 * finding.confidence) +
         "<dt>Advice</dt><dd>" + xml_escaped(advice_text(finding)) + "</dd>";
}

// Why the limit is what it is. The kinematics state one for each way in which a part shows.
std::string limit_reason(const Finding& finding, const analysis::Kinematics& kinematics) {
  const auto part = std::ranges::find_if(kinematics.signatures, [&](const auto& signature) {
    return signature.component == finding.component && signature.mechanism == finding.mechanism;
  });
  if (part == kinematics.signatures.end() || part->limit_why.empty()) return "";
  const bool is_less = finding.limit < part->depth_limit;
  if (finding.limit == part->depth_limit) return part->limit_why;
  if (is_less && finding.limit == part->aligned_limit) return "its lines are in phase, as a blow's";
  if (is_less) return "the part shows in noise alone";
  if (finding.limit == part->scatter_limit) {
    return "the phases of its lines scatter, as by pitch errors";
  }
  return "noise hides what is less; " + part->limit_why;
}

// @param counts  whether it says that the part is bad
std::string block_of(const Finding& finding, const ReportInput& input, bool counts) {
  std::string html =
      fmt::format("<div class=\"finding{}\"><h3>{}: {} – {}</h3>\n<dl>", counts ? "" : " within",
                  spoken(finding.component), spoken(finding.mechanism), limit_text(finding));
  html += fmt::format("<dt>Severity</dt><dd>modulation depth {}, limit {:.3f}{}</dd>",
                      severity_text(finding), finding.limit,
                      is_close(finding) ? ": its interval reaches across" : "");
  const std::string reason = limit_reason(finding, input.kinematics);
  if (!reason.empty()) html += "<dt>Limit</dt><dd>" + xml_escaped(reason) + "</dd>";
  if (std::isfinite(finding.severity_m_s2)) {
    html += "<dt>Amplitude</dt><dd>" + number(finding.severity_m_s2) + " m/s²</dd>";
  }
  const std::string sound = sound_text(finding);
  if (!sound.empty()) html += "<dt>Sound units</dt><dd>" + xml_escaped(sound) + "</dd>";
  const std::string rivals = rivals_text(finding);
  if (!rivals.empty()) html += "<dt>Certainty</dt><dd>" + xml_escaped(rivals) + "</dd>";
  const std::string cause = cause_text(finding);
  if (!cause.empty()) html += "<dt>Cause</dt><dd>" + xml_escaped(cause) + "</dd>";
  html += fmt::format("<dt>Order</dt><dd>{}, {}, the first point that shows it</dd>",
                      order_text(finding.order, input.kinematics.period_turns),
                      frequency_text(finding.frequency_Hz, finding.order));
  if (!finding.table4_item.empty()) {
    html += "<dt>Table 4</dt><dd>" + xml_escaped(finding.table4_item) + "</dd>";
  }
  html += "<dt>Evidence</dt><dd>" + evidence_of(finding, input.kinematics.period_turns) + "</dd>";
  html += fmt::format("<dt>Seen in</dt><dd>{} of {} points, IMF {}</dd>", finding.points.size(),
                      input.judgement.points.size(), imfs_of(finding));
  html += fmt::format(
      "<dt>Likelihood</dt><dd>logarithm of the ratio against noise {}, over all points, channels, "
      "IMFs and lines; p {}</dd>",
      number(finding.log_likelihood_ratio, 4), p_value_text(finding.p_value));
  const std::string growth = growth_text(finding);
  if (!growth.empty()) html += "<dt>Growth</dt><dd>" + xml_escaped(growth) + "</dd>";
  if (counts) html += consequence_of(finding);
  return html + "</dl></div>\n";
}

// Every hypothesis beside the others, so that the second is seen as well as the first.
std::string hypotheses_table(const analysis::Diagnosis& diagnosis, std::size_t points) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const Finding& h, const std::string& state) {
    rows.push_back({spoken(h.component) + ": " + spoken(h.mechanism), state, severity_text(h),
                    fmt::format("{:.3f}", h.limit), number(h.log_likelihood_ratio, 4),
                    p_value_text(h.p_value)});
  };
  for (const Finding& h : diagnosis.findings) add(h, "above its limit");
  for (const Finding& h : diagnosis.below_limit) add(h, "within its limit");
  for (const Finding& h : diagnosis.not_shown) add(h, shown_in(h, points));
  if (rows.empty()) return "";
  return "<h3>All hypotheses</h3>\n" +
         paragraph(
             "Severity is the modulation depth, its 95 % interval behind it. The likelihood ratio "
             "is against noise; p is how likely noise alone would give as much, for all lines of a "
             "part together; the four methods elsewhere in this report ask for one line at a time, "
             "in a few points, and may see it where this does not, or the other way round.") +
         table({"part", "state", "severity", "limit", "ln likelihood ratio", "p"}, rows);
}

std::string unknown_table(const std::vector<analysis::UnknownFamily>& families) {
  if (families.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const analysis::UnknownFamily& family : families) {
    rows.push_back({fmt::format("{:.4f}", family.spacing),
                    family.is_locked ? "gear-like" : "bearing-like",
                    std::to_string(family.harmonics), std::to_string(family.sidebands),
                    family.severity > 0 ? fmt::format("{:.3f}", family.severity) : "–",
                    p_value_text(family.p_value), std::to_string(family.points.size())});
  }
  return "<h3>Families that look like damage, and that no part explains</h3>\n" +
         table({"spacing (orders)", "kind", "harmonics", "sidebands", "severity", "p", "points"},
               rows);
}

std::string unexplained_table(const std::vector<SpectralLine>& lines, double period_turns) {
  if (lines.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const SpectralLine& line : lines) {
    rows.push_back({order_text(line.order, period_turns),
                    frequency_text(line.frequency_Hz, line.order), number(line.amplitude),
                    p_value_text(line.p_value)});
  }
  return "<h3>Lines that the kinematics does not explain</h3>\n" +
         table({"order", "frequency", "amplitude", "p"}, rows);
}

}  // namespace

std::string findings_section(const ReportInput& input) {
  const analysis::Diagnosis& diagnosis = input.judgement.diagnosis;
  const bool stand = findings_stand(input.judgement);
  std::string html;
  if (!stand && !(diagnosis.findings.empty() && diagnosis.below_limit.empty())) {
    html += paragraph("What follows was " + seen_but(input.judgement.ending) +
                      ". It names no bad part of the unit, and nothing is advised.");
  }
  for (const Finding& finding : diagnosis.findings) html += block_of(finding, input, stand);
  if (diagnosis.findings.empty()) {
    html += paragraph(diagnosis.resolvable ? "No finding above its limit."
                                           : "Nothing could be judged, so nothing was found.");
  }
  if (!diagnosis.below_limit.empty())
    html += "<h3>Significant, but within limits: no part is bad for these</h3>\n";
  for (const Finding& finding : diagnosis.below_limit) html += block_of(finding, input, false);
  html += hypotheses_table(diagnosis, input.judgement.points.size());
  html += unknown_table(diagnosis.unknown);
  html += unexplained_table(diagnosis.unexplained, input.kinematics.period_turns);
  return section("Findings", html);
}

}  // namespace rvbench::bench::report
