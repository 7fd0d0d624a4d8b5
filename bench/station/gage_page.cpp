#include "bench/station/gage_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/report/html.hpp"
#include "bench/station/page_parts.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

using report::number;
using report::paragraph;
using report::section;
using report::table;

std::string components_section(const GageAnswer& answer) {
  const analysis::GageStudy& study = answer.study;
  std::vector<std::vector<std::string>> rows;
  std::vector<PlotGroup> groups;
  for (const auto& [name, component] : named_components(study)) {
    rows.push_back({xml_escaped(name), number(component.deviation, 5),
                    number(component.interval.low) + " to " + number(component.interval.high),
                    percent(study.share(component)),
                    answer.tolerance
                        ? percent(analysis::share_of_tolerance(component, *answer.tolerance))
                        : "–"});
    groups.push_back(
        {name.substr(0, name.find(' ')),
         {{component.deviation, component.interval.low, component.interval.high, "after"}}});
  }
  rows.push_back({"TV total", number(study.total, 5), "", "100 %", ""});
  double most = study.total;
  for (const PlotGroup& group : groups) most = std::max(most, group.bars.front().value);
  SvgPlot bars("Standard deviations, with their intervals", {"", 0, double(groups.size())},
               {value_label(answer.data.unit), 0, 1.25 * most}, 1000, 260);
  bars.add_groups(groups);
  return section(
      "What the readings' scatter is made of",
      table({"component", "standard deviation", "interval", "of total", "of tolerance"}, rows) +
          bars.svg() +
          paragraph("Whiskers that leave the plot end beyond it: two or three operators "
                    "say little of how operators differ."));
}

// One operator's readings of each part.
struct OperatorReadings {
  Eigen::VectorXd mean, least, greatest;
};

OperatorReadings readings_of(std::size_t op, const analysis::GageReadings& readings) {
  const auto parts = Eigen::Index(readings.parts);
  OperatorReadings of{Eigen::VectorXd(parts), Eigen::VectorXd(parts), Eigen::VectorXd(parts)};
  for (Eigen::Index part = 0; part < parts; ++part) {
    const double* first =
        &readings.values[(std::size_t(part) * readings.operators + op) * readings.trials];
    const Eigen::Map<const Eigen::VectorXd> trials(first, Eigen::Index(readings.trials));
    of.mean[part] = trials.mean();
    of.least[part] = trials.minCoeff();
    of.greatest[part] = trials.maxCoeff();
  }
  return of;
}

std::string operators_section(const GageAnswer& answer) {
  const analysis::GageReadings& readings = answer.data.readings;
  std::vector<OperatorReadings> all;
  Eigen::VectorXd of_all = Eigen::VectorXd::Zero(Eigen::Index(readings.parts));
  for (std::size_t op = 0; op < readings.operators; ++op) {
    all.push_back(readings_of(op, readings));
    of_all += all.back().mean / double(readings.operators);
  }
  const auto [least, greatest] = std::ranges::minmax(readings.values);
  const PlotAxis y = axis_between(value_label(answer.data.unit), least, greatest);
  std::vector<SvgPlot> plots;
  for (std::size_t op = 0; op < readings.operators; ++op) {
    SvgPlot plot("Operator " + answer.data.operators[op],
                 {"part, in the order of the file", 0.5, double(readings.parts) + 0.5}, y);
    plot.add_band(1, 1, all[op].least, all[op].greatest);
    plot.add_trace(1, 1, of_all, "before");
    plot.add_trace(1, 1, all[op].mean, "after");
    plots.push_back(plot);
  }
  return section("Part by part",
                 "<p class=\"legend\"><span><i class=\"after\"></i>mean of this operator</span>"
                 "<span><i class=\"band\"></i>least to greatest reading</span>"
                 "<span><i class=\"before\"></i>mean of all operators</span></p>\n" +
                     figures(plots));
}

std::string anova_section(const analysis::GageAnova& anova) {
  const auto row = [](const char* name, const analysis::AnovaLine& line, bool tested) {
    return std::vector<std::string>{name,
                                    number(line.freedom),
                                    number(line.sum_of_squares, 6),
                                    number(line.mean_square(), 6),
                                    tested ? number(line.f, 4) : "",
                                    tested ? report::p_value_text(line.p_value) : ""};
  };
  return section("Analysis of variance",
                 table({"source", "freedom", "sum of squares", "mean square", "F", "p"},
                       {row("parts", anova.parts, true), row("operators", anova.operators, true),
                        row("operators x parts", anova.interaction, true),
                        row("repeatability", anova.repeatability, false)}));
}

std::string method_section(const GageAnswer& answer) {
  return section(
      "Method",
      paragraph(fmt::format(
          "Crossed study, all effects random, by analysis of variance (AIAG, Measurement Systems "
          "Analysis, 4th ed., ch. III). The interaction is pooled with repeatability where its p "
          "is above {:g}; parts and operators are held against what is left. Shares are of "
          "standard deviations; of the tolerance it is six of them. Intervals hold the truth in "
          "{:g} of 100 cases (modified large-sample: Graybill & Wang 1980, Ting et al. 1990). The "
          "word follows the manual's guideline: below 10 % acceptable, up to 30 % it may be, for "
          "what the measurement is for decides.",
          analysis::pooling_p, 100 * answer.confidence)));
}

}  // namespace

std::string make_gage_page(const GageAnswer& answer) {
  const GageWord word = word_of(answer);
  const char* style = word == GageWord::acceptable       ? "pass"
                      : word == GageWord::not_acceptable ? "fail"
                                                         : "";
  return station_document(spoken_word(word) + ": " + answer.file,
                          word_block("Gage study: " + answer.file, spoken_word(word), style,
                                     gage_sentence(answer), gage_reservation(answer)) +
                              components_section(answer) + operators_section(answer) +
                              anova_section(answer.study.anova) + method_section(answer));
}

}  // namespace rvbench::bench
