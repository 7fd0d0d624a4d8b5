#include "bench/report/pdf/page_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/findings_stand.hpp"
#include "bench/limit_checks.hpp"
#include "bench/report/finding_text.hpp"
#include "bench/report/html.hpp"
#include "bench/report/pdf/pages.hpp"
#include "bench/report/pdf/table.hpp"
#include "bench/report/pdf/verdict_sign.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/verdict_text.hpp"
#include "bench/run_results.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::pdf {
namespace {

using analysis::Finding;

constexpr std::size_t most_hashes = 5;
constexpr double sign_pt = 50, indent_pt = 8;

// Draws blocks from a little to the right.
Blocks indented(const Blocks& blocks, double by_pt) {
  Blocks moved;
  for (const Block& block : blocks) {
    moved.push_back({block.height_pt, [=](cairo_t* page, double x_pt, double y_pt) {
                       if (block.draw) block.draw(page, x_pt + by_pt, y_pt);
                     }});
  }
  return moved;
}

// One that holds all of them.
Block joined(const Blocks& blocks) {
  return {height_pt(blocks), [blocks](cairo_t* page, double x_pt, double y_pt) {
            draw_all(blocks, page, x_pt, y_pt);
          }};
}

// Beside each other, each at its distance from the left.
Block beside(const Block& left, const Block& right, double right_at_pt) {
  return {std::max(left.height_pt, right.height_pt), [=](cairo_t* page, double x_pt, double y_pt) {
            left.draw(page, x_pt, y_pt);
            right.draw(page, x_pt + right_at_pt, y_pt);
          }};
}

Block fact(const Typesetter& typesetter, const char* name, const std::string& value) {
  constexpr double name_pt = 50, value_pt = body_width_pt / 2 - name_pt - 6;
  TextStyle faint = small_text;
  faint.colour = colours::faint;
  const Blocks label = typesetter.text(name, faint, name_pt, 1);
  const Blocks text =
      typesetter.text(xml_escaped(value.empty() ? "–" : value), {.size_pt = 8}, value_pt, 2);
  return beside(joined(label), joined(text), name_pt);
}

Blocks finding_block(const Typesetter& typesetter, const Finding& finding,
                     const Judgement& judgement, bool counts) {
  const std::string title = report::spoken(finding.component) + ": " +
                            report::spoken(finding.mechanism) + " – " +
                            xml_escaped(report::limit_text(finding));
  std::string evidence =
      fmt::format("modulation depth {}, limit {:.3f}; seen in {} of {} points, order {:.4g}",
                  report::severity_text(finding), finding.limit, finding.points.size(),
                  judgement.points.size(), finding.order);
  if (counts) evidence += fmt::format("; confidence {:.0f} %", 100 * finding.confidence);
  Blocks blocks = typesetter.text(title, {.size_pt = 9, .bold = true}, body_width_pt, 1);
  append(blocks,
         indented(typesetter.text(xml_escaped(evidence), small_text, body_width_pt - indent_pt, 1),
                  indent_pt));
  if (!counts) return blocks;
  const std::string advice = "Advice: " + report::advice_text(finding);
  append(blocks, indented(typesetter.text(xml_escaped(advice), {}, body_width_pt - indent_pt, 2),
                          indent_pt));
  blocks.push_back(space(2));
  return blocks;
}

std::string nothing_found(const Judgement& judgement) {
  return judgement.diagnosis.resolvable ? "No finding above its limit."
                                        : "Nothing could be judged, so nothing was found.";
}

std::vector<std::string> limit_row(const LimitCheck& check, const Judgement& judgement) {
  return {xml_escaped(name_of(check)),
          std::isnan(check.measured) ? "–" : xml_escaped(with_unit(check.measured, check.unit)),
          xml_escaped(bound_text(check)), report::state_of(check),
          xml_escaped(report::readable_place(judgement, check.where))};
}

// Rows of the table, each no higher than two lines.
Blocks short_row(const Typesetter& typesetter, const std::vector<std::string>& cells, bool bold) {
  constexpr double widths_pt[] = {135, 60, 70, 90, 160};
  TextStyle style = small_text;
  style.bold = bold;
  Block row{0, [](cairo_t*, double, double) {}};
  double at_pt = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Blocks text = typesetter.text(cells[c], style, widths_pt[c] - 6, 2);
    row = beside(row, joined(text), at_pt);
    at_pt += widths_pt[c];
  }
  return {row};
}

bool is_signed(const std::string& file) {
  return file == "verdict.json" || file.starts_with("recording") || file == sums_in_report;
}

}  // namespace

Blocks part_heading(const Typesetter& typesetter, const std::string& text) {
  Blocks blocks{space(7)};
  append(blocks, typesetter.text(xml_escaped(text), {.size_pt = 9.5, .bold = true}, body_width_pt));
  blocks.push_back(space(1.5));
  return blocks;
}

Blocks banner(const Typesetter& typesetter, const Judgement& judgement) {
  const Outcome outcome = judgement.ending.outcome;
  const double text_at_pt = sign_pt + 24, width_pt = body_width_pt - text_at_pt - 10;
  Blocks text = typesetter.text(
      to_string(outcome), {.size_pt = 30, .bold = true, .colour = colour_of(outcome)}, width_pt);
  append(text, typesetter.text(xml_escaped(judgement.ending.reason), {.size_pt = 10}, width_pt, 3));
  append(text, typesetter.text(xml_escaped(report::meaning_of(judgement)), {}, width_pt, 3));
  const double height_pt_all = height_pt(text) + 12;
  return {{height_pt_all,
           [=](cairo_t* page, double x_pt, double y_pt) {
             fill_box(page, "#f5f7f9", x_pt, y_pt, body_width_pt, height_pt_all);
             fill_box(page, colour_of(outcome), x_pt, y_pt, 5, height_pt_all);
             draw_sign(page, outcome, x_pt + 15, y_pt + (height_pt_all - sign_pt) / 2, sign_pt);
             draw_all(text, page, x_pt + text_at_pt, y_pt + 5);
           }},
          space(6)};
}

Blocks facts_table(const Typesetter& typesetter, const Judgement& judgement) {
  const RunFacts& facts = judgement.facts;
  const std::string station =
      facts.preset.empty() ? facts.rig : facts.rig + ", preset " + facts.preset;
  std::string points = report::points_text(judgement);
  if (facts.resumed_at_point) points += fmt::format(", resumed at {}", *facts.resumed_at_point + 1);
  const std::pair<const char*, std::string> pairs[] = {
      {"Serial", facts.serial},
      {"Started", report::readable_time(facts.started_utc)},
      {"Unit", judgement.machine},
      {"Plan", facts.plan},
      {"Station", station},
      {"Points", points},
      {"Software", facts.software.empty() ? "" : "rvbench " + facts.software},
      {"Duration", std::isfinite(facts.duration_s)
                       ? fmt::format("{:.0f} s on the rig's clock", facts.duration_s)
                       : ""}};
  Blocks blocks;
  for (std::size_t i = 0; i + 1 < std::size(pairs); i += 2) {
    blocks.push_back(beside(fact(typesetter, pairs[i].first, pairs[i].second),
                            fact(typesetter, pairs[i + 1].first, pairs[i + 1].second),
                            body_width_pt / 2));
  }
  return blocks;
}

Blocks findings_in_words(const Typesetter& typesetter, const Judgement& judgement,
                         std::size_t most) {
  const std::vector<Finding>& findings = judgement.diagnosis.findings;
  const bool counts = findings_stand(judgement);
  Blocks blocks = part_heading(typesetter, "Findings");
  if (findings.empty()) {
    append(blocks, typesetter.text(nothing_found(judgement), {}, body_width_pt));
  } else if (!counts) {
    const std::string but = "What follows was " + report::seen_but(judgement.ending) +
                            ". It names no bad part of the unit, and nothing is advised.";
    append(blocks, typesetter.text(xml_escaped(but), small_text, body_width_pt, 3));
  }
  const std::size_t shown = std::min(most, findings.size());
  for (std::size_t i = 0; i < shown; ++i) {
    append(blocks, finding_block(typesetter, findings[i], judgement, counts));
  }
  if (shown < findings.size()) {
    const std::string rest =
        fmt::format("{} more above the limit in the appendix.", findings.size() - shown);
    append(blocks, typesetter.text(rest, small_text, body_width_pt));
  }
  return blocks;
}

Blocks limits_in_short(const Typesetter& typesetter, const Judgement& judgement, std::size_t most) {
  std::vector<LimitCheck> checks = judgement.limits;
  if (checks.empty()) return {};
  std::ranges::stable_sort(checks, std::greater{}, share_of_bound);
  const std::size_t shown = std::min(most, checks.size());
  Blocks blocks = part_heading(typesetter, "Limits of the plan");
  if (shown > 0) {
    append(blocks, short_row(typesetter, {"measure", "worst", "limit", "", "worst at"}, true));
  }
  for (std::size_t i = 0; i < shown; ++i) {
    append(blocks, short_row(typesetter, limit_row(checks[i], judgement), false));
  }
  if (shown < checks.size()) {
    const std::string rest = fmt::format("{} more in the appendix.", checks.size() - shown);
    append(blocks, typesetter.text(rest, small_text, body_width_pt));
  }
  return blocks;
}

Blocks hashes_to_sign(const Typesetter& typesetter, const ReportInput& input) {
  Blocks lines;
  std::size_t left_out = 0;
  for (const auto& [file, hash] : input.hashes) {
    if (!is_signed(file)) continue;
    if (lines.size() == most_hashes) {
      ++left_out;
      continue;
    }
    const std::string text = xml_escaped(hash + "  " + file);
    append(lines, typesetter.text(text, {.size_pt = 6.5, .mono = true}, body_width_pt, 1));
  }
  if (lines.empty()) return {};
  Blocks blocks = part_heading(typesetter, "What this report is of (SHA-256)");
  append(blocks, lines);
  if (left_out > 0) {
    append(blocks, typesetter.text(fmt::format("{} more in the appendix.", left_out), small_text,
                                   body_width_pt));
  }
  return blocks;
}

Block signature_lines(const Typesetter& typesetter) {
  constexpr double each_pt = body_width_pt / 3;
  std::vector<TextLine> names;
  for (const char* name : {"Name", "Date", "Signature"}) {
    names.push_back(typesetter.lines(name, small_text, each_pt, 1).front());
  }
  return {38, [names](cairo_t* page, double x_pt, double y_pt) {
            for (std::size_t i = 0; i < names.size(); ++i) {
              const double at_pt = x_pt + each_pt * double(i);
              fill_box(page, colours::ink, at_pt, y_pt + 26, each_pt - 14, 0.6);
              names[i].draw(page, at_pt, y_pt + 28);
            }
          }};
}

}  // namespace rvbench::bench::pdf
