#include "bench/report/explanation_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

using analysis::Explanation;
using report::number;
using report::section;
using report::table;

constexpr std::size_t most_records = 4;

std::string percent(double relative) { return number(100 * relative) + " %"; }

std::string sentence_section(const Explanation& e, const ExplainFacts& facts) {
  const bool quiet = e.verdict == analysis::ExplainVerdict::null;
  return fmt::format(
      "<h1>What {} leaves out</h1>\n<div class=\"verdict{}\"><div class=\"word\">{}</div>"
      "<div class=\"reason\">{}</div></div>\n",
      xml_escaped(facts.plant), quiet ? " pass" : "", to_string(e.verdict), xml_escaped(e.reason));
}

std::string estimates_table(const std::vector<analysis::Estimate>& all) {
  std::vector<std::vector<std::string>> rows;
  for (const analysis::Estimate& p : all) {
    rows.push_back({xml_escaped(p.name), number(p.value, 4), number(p.low, 4), number(p.high, 4),
                    xml_escaped(p.unit)});
  }
  return rows.empty() ? "" : table({"parameter", "value", "90 %: from", "to", "unit"}, rows);
}

std::string rivals_text(const std::vector<analysis::RivalEffect>& rivals, const char* than) {
  std::string text;
  for (const analysis::RivalEffect& rival : rivals) {
    text +=
        fmt::format("{}{} ({} by {} ± {})", text.empty() ? "" : ", ", report::spoken(rival.name),
                    than, number(rival.behind.delta), number(rival.behind.se));
  }
  return text.empty() ? "none came near" : text;
}

std::string effect_box(const analysis::ExplainedEffect& effect) {
  std::string of_class;
  for (const std::string& name : effect.one_of) {
    of_class += (of_class.empty() ? " One of: " : ", ") + report::spoken(name);
  }
  return fmt::format(
      "<div class=\"finding\"><h3>{}: {} ({})</h3>\n<p>{} Held-out error {} → {}; log density "
      "{:+.1f} ± {:.1f}; p {}; best in {:.0f} % of bootstraps.</p>\n{}<p>Rivals: {}.</p>\n"
      "<p>Would decide: {}.</p></div>\n",
      to_string(effect.verdict), report::spoken(effect.name), xml_escaped(effect.where), of_class,
      percent(effect.error_before), percent(effect.error_after), effect.over_before.delta,
      effect.over_before.se, report::p_value_text(effect.p_value), 100 * effect.share_won,
      estimates_table(effect.parameters), rivals_text(effect.rivals, "worse"),
      effect.next_experiment.empty() ? "nothing known" : xml_escaped(effect.next_experiment));
}

std::string errors_section(const Explanation& e) {
  const std::string any_after = e.ceiling_after.known ? percent(e.ceiling_after.error) : "–";
  return section(
      "Errors",
      table({"", "as the plant was", "with what was left out", "a law of any shape added"},
            {{"learned from", percent(e.trained_before), percent(e.trained_after), ""},
             {"left out, then predicted", percent(e.held_out_before), percent(e.held_out_after),
              any_after}}) +
          report::paragraph("Root mean square of measured minus simulated, over the standard "
                            "deviation of what was measured. On the plant as it was, a law of any "
                            "shape reaches " +
                            (e.ceiling_before.known ? percent(e.ceiling_before.error) : "–") +
                            "."));
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
  return section("Errors by record",
                 table({"record", "use", "channel", "RMS error before", "after", "unit",
                        "relative before", "after", "mean, predicted ± 90 %"},
                       rows));
}

std::string self_null_section(const analysis::SelfNull& self_null) {
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
                     percent(self_null.error))) +
                     estimates_table(self_null.found));
}

std::string residual_plots(const Comparisons& comparisons) {
  const auto& [before, after] = comparisons;
  std::string plots;
  for (std::size_t i = 0; i < std::min(before.size(), most_records); ++i) {
    const Twin::Comparison& b = before[i];
    const Eigen::VectorXd left_before = b.measured - b.simulated;
    const Eigen::VectorXd left_after = after[i].measured - after[i].simulated;
    const double end = b.first + static_cast<double>(b.measured.size()) * b.step;
    const PlotAxis over{b.over, b.first, end};
    const PlotAxis scale = axis_around(b.channel + " [" + b.unit + "]", left_before);
    const auto plot = [&](const std::string& title, const Eigen::VectorXd& y,
                          const PlotAxis& axis) {
      SvgPlot svg(title, over, axis);
      svg.add_trace(b.first, b.step, y);
      return svg.svg();
    };
    plots +=
        plot(b.record + ": left over before, " + percent(b.relative_error()), left_before, scale);
    plots += plot("and after, " + percent(after[i].relative_error()), left_after, scale);
  }
  return plots.empty()
             ? ""
             : section("What is left over", "<div class=\"figures\">" + plots + "</div>\n");
}

std::string data_section(const ExplainFacts& facts) {
  std::string body;
  for (const std::string& note : facts.notes) body += report::paragraph(note);
  std::vector<std::vector<std::string>> rows;
  for (const auto& [file, hash] : facts.hashes) {
    rows.push_back({xml_escaped(file), "<span class=\"hash\">" + hash + "</span>"});
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
  std::string effects;
  for (const analysis::ExplainedEffect& effect : e.effects) effects += effect_box(effect);
  html += section("Left out", effects);
  if (!e.cannot_exclude.empty()) {
    html += report::paragraph("Tried further, and refused: ") + "<p>" +
            rivals_text(e.cannot_exclude, "better than without") + "</p>\n";
  }
  html += errors_section(e);
  html += records_section(facts.records);
  html += self_null_section(e.self_null);
  html += residual_plots(comparisons);
  html += section("Calibration of the measurement", estimates_table(e.nuisances));
  html += section("Calibration of the plant", estimates_table(e.base));
  html += data_section(facts);
  return html + "</main></body></html>\n";
}

}  // namespace rvbench::bench
