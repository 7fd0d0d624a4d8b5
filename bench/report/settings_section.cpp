#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/limit_checks.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_events = 200;
constexpr std::size_t most_lacking = 24;

std::string document(const char* name, const std::string& json) {
  if (json.empty()) return "";
  return fmt::format("<h3>{}</h3>\n<pre>{}</pre>\n", name, xml_escaped(json));
}

std::string events_table(const RunFacts& facts) {
  if (facts.events.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [time_s, text] : facts.events) {
    if (rows.size() == most_events) {
      rows.push_back({"…", fmt::format("{} more in log.jsonl", facts.events.size() - most_events)});
      break;
    }
    rows.push_back({fmt::format("{:.2f}", time_s), xml_escaped(text)});
  }
  return "<h3>Events</h3>\n" + table({"time [s]", "event"}, rows);
}

std::string state_of(const analysis::QualityNote& note) {
  if (note.invalidates) return "<b>invalid</b>";
  return note.leaves_out ? "<b>left out</b>" : "noted";
}

std::string hashes_table(const ReportInput& input) {
  if (input.hashes.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [file, hash] : input.hashes) {
    rows.push_back({xml_escaped(file), "<span class=\"hash\">" + xml_escaped(hash) + "</span>"});
  }
  return "<h3>Hashes (SHA-256)</h3>\n" + table({"file", "hash"}, rows);
}

// The worst of all points, in milliseconds.
std::string worst_ms(const Judgement& judgement, double JudgedPoint::*time_uncertainty_s) {
  double worst_s = not_known;
  for (const JudgedPoint& point : judgement.points) {
    worst_s = std::fmax(worst_s, point.*time_uncertainty_s);
  }
  return std::isfinite(worst_s) ? fmt::format("±{:.3g} ms", 1e3 * worst_s) : "not known";
}

std::string bench_facts(const Judgement& judgement) {
  const RunFacts& facts = judgement.facts;
  if (facts.rig.empty()) return "";  // a stored recording: no bench took part
  const std::string seed = facts.seed ? std::to_string(*facts.seed) : "–";
  return fmt::format(
      "<dl><dt>Seed</dt><dd>{}</dd><dt>Requests repeated by the drive's driver</dt><dd>{}</dd>"
      "<dt>Shaft seen at standstill</dt><dd>{}</dd><dt>Brake released</dt><dd>{}</dd>"
      "<dt>Times of accelerations on the common clock</dt><dd>{}</dd>"
      "<dt>Times of torque and angle on it</dt><dd>{}</dd></dl>\n",
      seed, facts.drive_retries, facts.shaft_stopped ? "yes" : "no",
      facts.brake_released ? "yes" : "no",
      worst_ms(judgement, &JudgedPoint::acceleration_time_uncertainty_s),
      worst_ms(judgement, &JudgedPoint::torque_time_uncertainty_s));
}

std::string unbroken(const std::string& html) {
  return "<span class=\"unbroken\">" + html + "</span>";
}

std::string narrowed_to(const LimitCheck& check) {
  if (!check.component.empty()) return check.component;
  return (check.of.empty() ? "any" : check.of) + at_text(check.at);
}

std::string limits_title(const RunFacts& facts) {
  if (facts.limits_version.empty()) return "Limits of the plan";
  return "Limits, version " + xml_escaped(facts.limits_version) + ", in place of the plan's";
}

// All points at which a limit could not be held against anything.
std::string points_lacking(const Judgement& judgement, const LimitCheck& check) {
  const std::size_t shown = std::min(check.lacking.size(), most_lacking);
  std::string list;
  for (std::size_t i = 0; i < shown; ++i) {
    list += (i > 0 ? "; " : "") + readable_place(judgement, check.lacking[i]);
  }
  if (shown < check.lacking.size()) list += fmt::format("; {} more", check.lacking.size() - shown);
  return paragraph(name_of(check) + " was not measured at " + list + ".");
}

}  // namespace

std::string state_of(const LimitCheck& check) {
  std::string state;
  if (!is_measured(check)) state = "<b>" + xml_escaped(why_unmeasured(check)) + "</b>";
  if (std::isnan(check.measured)) return state;
  if (!state.empty()) state += "; ";
  state += is_beyond(check) ? fmt::format("<b>{}</b>", beyond(check)) : "within";
  const std::string coverage = coverage_of(check);
  return coverage.empty() ? state : state + ", " + coverage;
}

std::string limits_section(const ReportInput& input) {
  std::string html;
  std::vector<std::vector<std::string>> rows;
  for (const LimitCheck& check : input.judgement.limits) {
    rows.push_back(
        {xml_escaped(check.measure), xml_escaped(narrowed_to(check)), number(check.measured),
         unbroken(bound_name(check) + (" " + number(bound_of(check)))),
         unbroken(xml_escaped(check.unit)), state_of(check),
         xml_escaped(readable_place(input.judgement, check.where)), xml_escaped(check.why)});
  }
  if (!rows.empty()) {
    html += "<h3>" + limits_title(input.judgement.facts) + "</h3>\n<div class=\"limits\">" +
            table({"measure", "of", "measured", "limit", "unit", "", "worst at", "why"}, rows) +
            "</div>\n";
  }
  for (const LimitCheck& check : input.judgement.limits) {
    if (!check.lacking.empty()) html += points_lacking(input.judgement, check);
  }
  std::vector<std::vector<std::string>> notes;
  for (const analysis::QualityNote& note : input.judgement.diagnosis.quality) {
    notes.push_back({xml_escaped(readable_place(input.judgement, note.where)),
                     xml_escaped(note.what), state_of(note)});
  }
  for (const JudgedPoint& point : input.judgement.points) {
    if (point.status == "ok" || point.status == not_recorded) continue;
    notes.push_back({xml_escaped(caption_of(point)), xml_escaped(point.status), "<b>invalid</b>"});
  }
  html += notes.empty() ? paragraph("No channel shows a fault of its own.")
                        : "<h3>Quality of the data</h3>\n" + table({"where", "what", ""}, notes);
  return section("Limits and data quality", html);
}

std::string settings_section(const ReportInput& input) {
  return section("Settings and traceability",
                 bench_facts(input.judgement) + events_table(input.judgement.facts) +
                     hashes_table(input) +
                     document("Plan, every default spelled out", input.plan_json) +
                     document("Rig, every default spelled out", input.rig_json));
}

}  // namespace rvbench::bench::report
