#include <fmt/format.h>

#include <algorithm>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

using analysis::Finding;
using analysis::SpectralLine;

std::string evidence_of(const Finding& finding, double period_turns) {
  std::string text;
  const std::size_t lines = std::min(finding.line_orders.size(), finding.line_depths.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(lines, 12); ++i) {
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

std::string block_of(const Finding& finding, const ReportInput& input, bool above) {
  std::string html =
      fmt::format("<div class=\"finding{}\"><h3>{}: {}</h3>\n<dl>", above ? "" : " within",
                  spoken(finding.component), spoken(finding.mechanism));
  html += fmt::format("<dt>Severity</dt><dd>modulation depth {:.3f}, limit {:.3f} ({})</dd>",
                      finding.severity, finding.limit, above ? "above" : "within");
  html += fmt::format("<dt>Order</dt><dd>{}, {}, the first point that shows it</dd>",
                      order_text(finding.order, input.kinematics.period_turns),
                      frequency_text(finding.frequency_Hz, finding.order));
  if (!finding.table4_item.empty()) {
    html += "<dt>Table 4</dt><dd>" + xml_escaped(finding.table4_item) + "</dd>";
  }
  html += "<dt>Evidence</dt><dd>" + evidence_of(finding, input.kinematics.period_turns) + "</dd>";
  html += fmt::format("<dt>Seen in</dt><dd>{} of {} points, IMF {}</dd>", finding.points.size(),
                      input.judgement.points.size(), imfs_of(finding));
  html += fmt::format("<dt>Statistic</dt><dd>{} times the local noise floor, p {}</dd>",
                      number(finding.statistic, 4), p_value_text(finding.p_value));
  if (above) {
    html += fmt::format(
        "<dt>Confidence</dt><dd>{:.0f} %: this part's share of severity over limit, among all "
        "findings above theirs</dd>",
        100 * finding.confidence);
  }
  if (above) html += "<dt>Advice</dt><dd>" + xml_escaped(finding.advice) + "</dd>";
  return html + "</dl></div>\n";
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
  std::string html;
  for (const Finding& finding : diagnosis.findings) html += block_of(finding, input, true);
  if (diagnosis.findings.empty()) {
    html += paragraph(diagnosis.resolvable ? "No finding above its limit."
                                           : "Nothing could be judged, so nothing was found.");
  }
  if (!diagnosis.below_limit.empty()) html += "<h3>Significant, but within limits</h3>\n";
  for (const Finding& finding : diagnosis.below_limit) html += block_of(finding, input, false);
  html += unexplained_table(diagnosis.unexplained, input.kinematics.period_turns);
  return section("Findings", html);
}

}  // namespace rvbench::bench::report
