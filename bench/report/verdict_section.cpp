#include <fmt/format.h>

#include <cmath>

#include "bench/findings_stand.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

const char* class_of(Outcome outcome) {
  if (outcome == Outcome::pass) return "pass";
  return outcome == Outcome::fail ? "fail" : "other";
}

const char* meaning_of_invalid(const Judgement& judgement) {
  switch (lack_of(judgement)) {
    case Lack::limit_measured:
      return "A limit could not be held against the data, so the unit is neither passed nor "
             "failed. What was found in the data stands. Record what the limit needs, or take it "
             "out of the plan.";
    case Lack::part_shown:
      return "Of one part the data do not tell whether it is good, so the unit is neither passed "
             "nor failed. What was found of others stands. Measure longer, or at more points.";
    case Lack::sound_data: break;
  }
  return "The data cannot be trusted: nothing is said about the unit. Measure again.";
}

// What the word means for the person who holds the unit.
const char* meaning_of(const Judgement& judgement) {
  const Ending& ending = judgement.ending;
  switch (ending.outcome) {
    case Outcome::pass: return "The unit is good.";
    case Outcome::fail: return "The unit is bad.";
    case Outcome::invalid: return meaning_of_invalid(judgement);
    case Outcome::aborted:
      return "The run was stopped before its end: nothing is said about the unit.";
    case Outcome::error: break;
  }
  if (ending.error_kind == ErrorKind::safety_trip) {
    return "An interlock stopped the bench: nothing is said about the unit. Find the cause first.";
  }
  return "The bench, not the unit, is at fault: nothing is said about the unit.";
}

// "20260102T030405Z" → "2026-01-02 03:04:05 UTC"; anything else as it is.
std::string readable_time(const std::string& utc) {
  if (utc.size() < 16 || utc[8] != 'T') return utc;
  return fmt::format("{}-{}-{} {}:{}:{} UTC", utc.substr(0, 4), utc.substr(4, 2), utc.substr(6, 2),
                     utc.substr(9, 2), utc.substr(11, 2), utc.substr(13, 2));
}

std::string row(const char* name, const std::string& value) {
  if (value.empty()) return "";
  return fmt::format("<dt>{}</dt><dd>{}</dd>", name, xml_escaped(value));
}

std::string points_text(const Judgement& judgement) {
  std::size_t recorded = 0;
  for (const JudgedPoint& point : judgement.points)
    recorded += point.status != "not_recorded" ? 1 : 0;
  return fmt::format("{} of {} recorded", recorded, judgement.points.size());
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
