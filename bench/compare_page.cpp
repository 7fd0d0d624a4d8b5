#include "bench/compare_page.hpp"

#include <fmt/format.h>

#include "analysis/compare/compared_channels.hpp"
#include "analysis/compare/headlines.hpp"
#include "bench/compare_sections.hpp"
#include "bench/compare_text.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

using analysis::Comparison;
using report::section;
using report::table;

std::string sentence_section(const Comparison& comparison, const CompareFacts& facts) {
  const analysis::ChangeWord word = analysis::word_of(analysis::counts_of(comparison));
  return fmt::format(
      "<h1>Before and after: {}</h1>\n<div class=\"verdict{}\"><div class=\"word\">{}</div>"
      "<div class=\"reason\">{}</div><p>{}</p></div>\n"
      "<dl><dt>A, before</dt><dd>{}</dd><dt>B, after</dt><dd>{}</dd></dl>\n",
      xml_escaped(facts.kinematics.machine),
      word == analysis::ChangeWord::not_changed ? " pass" : "", spoken_word(word),
      xml_escaped(compare_sentence(comparison, facts.kinematics)),
      xml_escaped(compare_reservation(comparison)), xml_escaped(facts.a), xml_escaped(facts.b));
}

std::string families_section(const Comparison& comparison, const analysis::Kinematics& kinematics) {
  std::string items;
  for (const analysis::FamilyHeadline& f : analysis::family_headlines(comparison)) {
    items += "<li>" + xml_escaped(family_text(f, kinematics)) + "</li>\n";
  }
  if (items.empty()) return "";
  return section("Whose lines changed",
                 report::paragraph("Most first. Parts of the gear train share lines, so that what "
                                   "one of them did others show as well; a peak of parts that slip "
                                   "is counted for one of them, or for both where they cannot be "
                                   "told apart.") +
                     "<ul>\n" + items + "</ul>\n");
}

std::string headlines_section(const Comparison& comparison, double period_turns) {
  std::vector<std::vector<std::string>> rows;
  for (const analysis::Headline& h : analysis::headlines(comparison)) {
    const analysis::Quantity& quantity = comparison.quantities[h.quantity];
    const analysis::Change& most = comparison.changes[h.strongest];
    rows.push_back({xml_escaped(quantity.name),
                    quantity.is_line() ? report::order_text(quantity.order, period_turns) : "",
                    report::spoken(quantity.component), fmt::format("<b>{:+.1f}</b>", h.median_dB),
                    fmt::format("{:+.1f} to {:+.1f}", h.least_dB, h.most_dB),
                    fmt::format("{} of {}", h.changed, h.compared),
                    fmt::format("{} of {}", h.points, comparison.points.size()),
                    xml_escaped(place_text(most, comparison)),
                    xml_escaped(levels_text(most, comparison)),
                    fmt::format("{:+.1f} ± {:.2g}", most.change_dB, most.uncertainty_dB),
                    "<span style=\"white-space:nowrap\">" + report::p_value_text(most.adjusted_p) +
                        "</span>"});
  }
  if (rows.empty()) return "";
  return section("Each line and level that changed",
                 table({"line or level", "order", "part", "median [dB]", "range [dB]", "cells",
                        "points", "most at", "A → B", "by [dB, 95 %]", "p"},
                       rows));
}

std::string only_text(const std::vector<analysis::PointRecords>& points, const char* side) {
  std::string text;
  for (const analysis::PointRecords& point : points) {
    text += report::paragraph(fmt::format("{}: only in {}, {} records.",
                                          analysis::point_text(point.speed_rpm, point.load_pct),
                                          side, point.records.size()));
  }
  return text;
}

std::string left_out_section(const Comparison& comparison) {
  std::string body = only_text(comparison.only_a, "A") + only_text(comparison.only_b, "B");
  std::vector<std::vector<std::string>> rows;
  for (const analysis::NotCompared& out : comparison.left_out) {
    rows.push_back({xml_escaped(out.where), xml_escaped(out.why)});
  }
  if (!rows.empty()) body += table({"where", "why"}, rows);
  return section("Not compared, or with a reservation", body);
}

std::string method_section(const Comparison& comparison, const CompareFacts& facts) {
  const analysis::CompareOptions& options = comparison.options;
  std::string body = report::paragraph(fmt::format(
      "Compared are levels of the signals, and the lines that the kinematics names. A change is "
      "the difference of mean levels in dB. Its scatter is that of the repeats of A and B or, "
      "where each has one record, of its parts, pooled, and drawn towards what cells of the same "
      "kind say (Smyth 2004): a cell is a level or line in a channel at a point. A line is seen "
      "where noise shows as much with a probability of {:g} at most, one of a part that slips "
      "where all lines of the part together show with {:g} at most. Changed: more than {:g} dB by "
      "Student's test, at a false discovery rate of {:g} % over all that is seen "
      "(Benjamini & Hochberg 1995). Not changed: a change above {:g} dB, or less where it is told, "
      "would have been seen in nine of ten cases. Else it cannot be told. What changed may be the "
      "unit, its mounting or the bench.",
      options.seen_p, options.found_p, options.least_dB, 100 * options.false_share,
      options.blind_dB));
  std::vector<std::vector<std::string>> rows;
  for (const auto& [file, hash] : facts.hashes) {
    rows.push_back({"<span class=\"hash\">" + xml_escaped(file) + "</span>",
                    "<span class=\"hash\">" + hash + "</span>"});
  }
  if (!rows.empty()) body += table({"recording", "SHA-256"}, rows);
  return section("Method and data", body + report::paragraph("rvbench " + facts.software));
}

}  // namespace

std::string make_compare_page(const Comparison& comparison, const CompareFacts& facts,
                              const SpectrumLoader& spectra) {
  const std::string word = spoken_word(analysis::word_of(analysis::counts_of(comparison)));
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         xml_escaped(word + ": " + facts.kinematics.machine) + "</title>\n<style>\n" +
         report::style_sheet() + "</style></head><body><main>\n" +
         sentence_section(comparison, facts) + report::compare_matrix_section(comparison) +
         families_section(comparison, facts.kinematics) +
         report::compare_spectra_section(comparison, facts, spectra) +
         headlines_section(comparison, facts.kinematics.period_turns) +
         left_out_section(comparison) + method_section(comparison, facts) +
         "</main></body></html>\n";
}

}  // namespace rvbench::bench
