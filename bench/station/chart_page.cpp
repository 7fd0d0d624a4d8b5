#include "bench/station/chart_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/html.hpp"
#include "bench/station/page_parts.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using report::number;
using report::paragraph;
using report::section;
using report::table;

constexpr int wide_px = 1000;

PlotAxis points_axis(const ChartAnswer& answer) {
  return {"value, in the order of the file", 0.5, double(answer.data.values.size()) + 0.5};
}

// A level over all points.
void add_level(SvgPlot& plot, Index points, double level, const std::string& style) {
  plot.add_trace(0.5, double(points), Eigen::Vector2d(level, level), style);
}

// Where anything fired, each point once, with the first rule that did.
void add_signals(SvgPlot& plot, const ChartAnswer& answer) {
  Index last = -1;
  for (const ChartEvent& event : events_of(answer)) {
    if (event.at != last) plot.add_mark(double(event.at + 1), event.rule);
    last = event.at;
  }
}

SvgPlot individuals_plot(const ChartAnswer& answer) {
  const analysis::ChartBaseline& baseline = answer.chart.baseline;
  const VectorXd& values = answer.data.values;
  double least = std::min(values.minCoeff(), baseline.lower());
  double greatest = std::max(values.maxCoeff(), baseline.upper());
  SvgPlot plot("Individuals", points_axis(answer),
               axis_between(value_label(answer.data.unit), least, greatest), wide_px, 300);
  add_level(plot, values.size(), baseline.centre, "whisker");
  add_level(plot, values.size(), baseline.lower(), "before");
  add_level(plot, values.size(), baseline.upper(), "before");
  plot.add_trace(1, 1, values);
  add_signals(plot, answer);
  return plot;
}

SvgPlot ranges_plot(const ChartAnswer& answer) {
  const analysis::ChartBaseline& baseline = answer.chart.baseline;
  const VectorXd& ranges = answer.chart.ranges;
  const double greatest =
      std::max(ranges.tail(ranges.size() - 1).maxCoeff(), baseline.upper_range());
  SvgPlot plot("Moving ranges", points_axis(answer),
               {value_label(answer.data.unit), 0, 1.06 * greatest});
  add_level(plot, ranges.size(), baseline.mean_range, "whisker");
  add_level(plot, ranges.size(), baseline.upper_range(), "before");
  plot.add_trace(1, 1, ranges);
  return plot;
}

SvgPlot ewma_plot(const ChartAnswer& answer) {
  const analysis::EwmaChart& ewma = answer.ewma;
  SvgPlot plot("Weighted mean (EWMA)", points_axis(answer),
               axis_between(value_label(answer.data.unit),
                            std::min(ewma.means.minCoeff(), ewma.lower.minCoeff()),
                            std::max(ewma.means.maxCoeff(), ewma.upper.maxCoeff())));
  plot.add_trace(1, 1, ewma.lower, "before");
  plot.add_trace(1, 1, ewma.upper, "before");
  plot.add_trace(1, 1, ewma.means);
  return plot;
}

std::string charts_section(const ChartAnswer& answer) {
  return section("Charts",
                 "<p class=\"legend\"><span><i class=\"after\"></i>values</span>"
                 "<span><i class=\"before\"></i>control limits</span></p>\n" +
                     individuals_plot(answer).svg() +
                     figures({ranges_plot(answer), ewma_plot(answer)}));
}

std::string signals_section(const ChartAnswer& answer) {
  std::vector<std::vector<std::string>> rows;
  for (const ChartEvent& event : events_of(answer)) {
    rows.push_back({xml_escaped(answer.data.labels[std::size_t(event.at)]),
                    number(answer.data.values[event.at], 6), xml_escaped(event.rule),
                    xml_escaped(event.meaning)});
  }
  if (rows.empty()) return "";
  return section("Signals", table({"at", "value", "rule", "meaning"}, rows));
}

std::string capability_section(const ChartAnswer& answer) {
  if (!answer.capability) return "";
  std::string items;
  for (const std::string& line : capability_lines(answer)) {
    items += "<li>" + xml_escaped(line) + "</li>\n";
  }
  const auto limit = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string("none");
  };
  return section("Capability", paragraph("Limits: lower " + limit(answer.limits.lower) +
                                         ", upper " + limit(answer.limits.upper) + ".") +
                                   "<ul>\n" + items + "</ul>\n");
}

std::string method_section(const ChartAnswer& answer) {
  return section(
      "Method",
      paragraph(fmt::format(
          "Individuals and moving range: the centre is the mean of {} values, limits are three "
          "standard deviations of neighbours (mean range / 1.128) to either side; ranges up to "
          "3.267 mean ranges. Weighted mean of weight 0.2, limits 2.962 of its own standard "
          "deviations, exact from the first value on (Lucas & Saccucci 1990). Cp and Cpk take the "
          "deviation of neighbours, Pp and Ppk that of all values; intervals by chi-square and "
          "Bissell (1990).",
          answer.chart.baseline.points)));
}

}  // namespace

std::string make_chart_page(const ChartAnswer& answer) {
  std::string warnings;
  for (const std::string& warning : chart_warnings(answer)) {
    warnings += (warnings.empty() ? "" : " ") + warning;
  }
  return station_document(
      spoken_control(answer) + ": " + answer.file,
      word_block("Control chart: " + answer.file, spoken_control(answer),
                 answer.is_in_control() ? "pass" : "fail", chart_sentence(answer), warnings) +
          charts_section(answer) + capability_section(answer) + signals_section(answer) +
          method_section(answer));
}

}  // namespace rvbench::bench
