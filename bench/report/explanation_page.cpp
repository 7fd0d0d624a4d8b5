#include "bench/report/explanation_page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bench/report/explanation_sections.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

using analysis::Explanation;
using report::number;
using report::section;
using report::table;

std::string percent(double relative) { return number(100 * relative) + " %"; }

std::string estimates_table(const std::vector<analysis::Estimate>& all) {
  std::vector<std::vector<std::string>> rows;
  for (const analysis::Estimate& p : all) {
    rows.push_back({xml_escaped(p.name), number(p.value, 4), number(p.low, 4), number(p.high, 4),
                    xml_escaped(p.unit)});
  }
  return rows.empty() ? "" : table({"parameter", "value", "90 %: from", "to", "unit"}, rows);
}

// Log densities apart, in nats.
std::string apart_text(const analysis::RivalEffect& of, const char* how) {
  const std::string place = of.where.empty() ? "" : ", " + xml_escaped(of.where);
  return fmt::format("{}{} ({} by {} ± {})", report::spoken(of.name), place, how,
                     number(std::abs(of.behind.delta)), number(of.behind.se));
}

std::string rivals_text(const std::vector<analysis::RivalEffect>& rivals) {
  std::string text;
  for (const analysis::RivalEffect& rival : rivals) {
    text +=
        (text.empty() ? "" : ", ") + apart_text(rival, rival.behind.delta < 0 ? "better" : "worse");
  }
  return text.empty() ? "none came near" : text;
}

std::string refused_text(const std::vector<analysis::RivalEffect>& refused) {
  std::string text;
  for (const analysis::RivalEffect& one : refused) {
    text += (text.empty() ? "" : ", ") +
            apart_text(one, one.behind.delta < 0 ? "worse than without" : "better than without");
  }
  return text;
}

// "1.131e-06 m (90 %: 8.05e-07 to 1.46e-06)"
std::string size_text(const analysis::Estimate& size) {
  return fmt::format("{} <b>{} {}</b> (90 %: {} to {})", report::spoken(size.name),
                     number(size.value, 4), xml_escaped(size.unit), number(size.low),
                     number(size.high));
}

// One effect as a sentence: what, where, how much, what else it could be, what would decide.
std::string sentence(const analysis::ExplainedEffect& effect) {
  std::string what = "<b>" + report::spoken(effect.name) + "</b>";
  for (const std::string& name : effect.one_of) {
    if (name != effect.name) what += " or <b>" + report::spoken(name) + "</b>";
  }
  std::string text = fmt::format("left out: {}; where: {}", what, xml_escaped(effect.where));
  if (!effect.parameters.empty()) text += "; size: " + size_text(effect.parameters.front());
  text += "; rivals: " + rivals_text(effect.rivals);
  if (!effect.next_experiment.empty()) {
    text += "; next experiment: " + xml_escaped(effect.next_experiment);
  }
  return "<li>" + text + "</li>\n";
}

std::string sentence_section(const Explanation& e, const ExplainFacts& facts) {
  const bool quiet = e.verdict == analysis::ExplainVerdict::null;
  std::string html = fmt::format(
      "<h1>What {} leaves out</h1>\n<div class=\"verdict{}\"><div class=\"word\">{}</div>"
      "<div class=\"reason\">{}</div>\n",
      xml_escaped(facts.plant), quiet ? " pass" : "", to_string(e.verdict), xml_escaped(e.reason));
  std::string effects;
  for (const analysis::ExplainedEffect& effect : e.effects) effects += sentence(effect);
  if (!e.cannot_exclude.empty()) {
    effects += "<li>cannot exclude: " + refused_text(e.cannot_exclude) + "</li>\n";
  }
  if (!effects.empty()) html += "<ul class=\"left-out\">\n" + effects + "</ul>\n";
  return html + "</div>\n";
}

// Long tables are there to be looked up.
std::string folded(const std::string& heading, const std::string& summary,
                   const std::string& body) {
  if (body.empty()) return {};
  return section(heading, "<details><summary>" + summary + "</summary>\n" + body + "</details>\n");
}

std::string effect_box(const analysis::ExplainedEffect& effect, bool in_standard_errors) {
  std::string of_class;
  for (const std::string& name : effect.one_of) {
    of_class += (of_class.empty() ? " One of: " : ", ") + report::spoken(name);
  }
  return fmt::format(
      "<div class=\"finding\"><h3>{}: {} ({})</h3>\n<p>{} Held-out error {} → {}; log density "
      "{:+.1f} ± {:.1f}; p {}; best in {:.0f} % of bootstraps.</p>\n{}<p>Rivals: {}.</p>\n"
      "<p>Would decide: {}.</p></div>\n",
      to_string(effect.verdict), report::spoken(effect.name), xml_escaped(effect.where), of_class,
      analysis::error_text(effect.error_before, in_standard_errors),
      analysis::error_text(effect.error_after, in_standard_errors), effect.over_before.delta,
      effect.over_before.se, report::p_value_text(effect.p_value), 100 * effect.share_won,
      estimates_table(effect.parameters), rivals_text(effect.rivals),
      effect.next_experiment.empty() ? "nothing known" : xml_escaped(effect.next_experiment));
}

std::string mean_text(const std::optional<PredictedMean>& mean) {
  if (!mean) return {};
  return fmt::format("{:.6g}, {:.6g} ± {:.2g}{}", mean->measured, mean->predicted, mean->half_width,
                     mean->is_inside() ? "" : ": outside");
}

std::string records_section(const std::vector<RecordError>& records) {
  std::vector<std::vector<std::string>> rows;
  for (const RecordError& r : records) {
    rows.push_back({xml_escaped(r.record), r.learned_from ? "learned from" : "only predicted",
                    xml_escaped(r.channel), number(r.before), number(r.after), xml_escaped(r.unit),
                    percent(r.relative_before), percent(r.relative_after), mean_text(r.mean)});
  }
  if (rows.empty()) return {};
  return folded("Errors by record", fmt::format("{} rows", rows.size()),
                table({"record", "use", "channel", "RMS error before", "after", "unit",
                       "relative before", "after", "mean, predicted ± 90 %"},
                      rows));
}

std::string self_null_section(const analysis::SelfNull& self_null, bool in_standard_errors) {
  if (!self_null.known) {
    return section("One repeat as the model of another",
                   report::paragraph("No two recordings repeat each other: not asked."));
  }
  return section("One repeat as the model of another",
                 report::paragraph(fmt::format(
                     "{} They differ by {}.",
                     self_null.found.empty()
                         ? "NULL: nothing is found between two repeats."
                         : "Something changed from one repeat to the other: smaller effects than "
                           "this are not to be believed.",
                     analysis::error_text(self_null.error, in_standard_errors))) +
                     estimates_table(self_null.found));
}

std::string data_section(const ExplainFacts& facts) {
  std::string body;
  for (const std::string& note : facts.notes) body += report::paragraph(note);
  std::vector<std::vector<std::string>> rows;
  for (const auto& [file, hash] : facts.hashes) {
    rows.push_back({"<span class=\"hash\">" + xml_escaped(file) + "</span>",
                    "<span class=\"hash\">" + hash + "</span>"});
  }
  if (!rows.empty()) body += table({"recording", "SHA-256"}, rows);
  if (!facts.plant_updated.empty()) {
    body += report::paragraph("The plant with what was left out: " + facts.plant_updated);
  }
  return section("Data and software", body + report::paragraph("rvbench " + facts.software));
}

}  // namespace

std::string make_explanation_page(const Explanation& e, const ExplainFacts& facts,
                                  const Comparisons& comparisons) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      xml_escaped(std::string(to_string(e.verdict)) + ": " + facts.plant) + "</title>\n<style>\n" +
      report::style_sheet() + "</style></head><body><main>\n";
  html += sentence_section(e, facts);
  html += report::explained_errors_section(e, comparisons);
  html += report::located_section(facts.located);
  html += report::overlays_section(comparisons);
  html += report::residual_maps_section(comparisons);
  std::string effects;
  for (const analysis::ExplainedEffect& effect : e.effects)
    effects += effect_box(effect, e.in_standard_errors);
  html += section("Each effect", effects);
  html += self_null_section(e.self_null, e.in_standard_errors);
  html += records_section(facts.records);
  html += folded("Calibration of the measurement", "nuisances", estimates_table(e.nuisances));
  html += folded("Calibration of the plant", "numbers that are known within bounds, or not at all",
                 estimates_table(e.base));
  html += data_section(facts);
  return html + "</main></body></html>\n";
}

}  // namespace rvbench::bench
