#include <fmt/format.h>

#include <cmath>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/verdict_text.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

const char* class_of(Outcome outcome) {
  if (outcome == Outcome::pass) return "pass";
  return outcome == Outcome::fail ? "fail" : "other";
}

std::string row(const char* name, const std::string& value) {
  if (value.empty()) return "";
  return fmt::format("<dt>{}</dt><dd>{}</dd>", name, xml_escaped(value));
}

}  // namespace

std::string verdict_section(const ReportInput& input) {
  const Judgement& judgement = input.judgement;
  const RunFacts& facts = judgement.facts;
  std::string html = fmt::format("<h1>Vibration acceptance report{}{}</h1>\n",
                                 facts.serial.empty() ? "" : ": ", xml_escaped(facts.serial));
  html += fmt::format(
      "<div class=\"verdict {}\"><div class=\"word\">{}</div><div "
      "class=\"reason\">{}</div><div>{}</div></div>\n<dl>",
      class_of(judgement.ending.outcome), to_string(judgement.ending.outcome),
      xml_escaped(judgement.ending.reason), meaning_of(judgement));
  html += row("Serial", facts.serial) + row("Machine", judgement.machine);
  html += row("Started", readable_time(facts.started_utc)) + row("Plan", facts.plan);
  html += row("Rig", facts.preset.empty() ? facts.rig : facts.rig + ", preset " + facts.preset);
  html += row("Points", points_text(judgement));
  if (std::isfinite(facts.duration_s))
    html += row("Duration", fmt::format("{:.0f} s on the rig's clock", facts.duration_s));
  html += row("Software", "rvbench " + facts.software) + "</dl>\n";
  if (facts.resumed_at_point) {
    html += paragraph(
        fmt::format("This run was interrupted and resumed at point {} after a new warm-up.",
                    *facts.resumed_at_point + 1));
  }
  return html;
}

std::string signature_section(const ReportInput&) {
  return "<div class=\"signature\"><div>Name</div><div>Date</div><div>Signature</div></div>\n";
}

}  // namespace rvbench::bench::report
