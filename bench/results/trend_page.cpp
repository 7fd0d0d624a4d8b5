#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "bench/limit_checks.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/results/trend.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

constexpr int width_px = 900, height_px = 320;

std::string plot_of(const Trend& trend) {
  const auto count = Eigen::Index(trend.values.size());
  if (count < 2) return "";
  Eigen::VectorXd days(count), values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const RunValue& value = trend.values[std::size_t(i)];
    days[i] = days_of_utc(value.started_utc).value_or(0);
    values[i] = value.value;
  }
  const double first = days[0], span = days[count - 1] - first;
  if (!(span > 0)) return "";
  // The plot takes samples at even steps: each value goes to its step, the rest is joined straight.
  constexpr Eigen::Index grid = 1001;
  const double step = span / double(grid - 1);
  Eigen::VectorXd joined(grid);
  for (Eigen::Index i = 0, at = 0; i < grid; ++i) {
    const double day = first + double(i) * step;
    while (at + 2 < count && days[at + 1] <= day) ++at;
    const double gap = days[at + 1] - days[at];
    const double share = gap > 0 ? std::fmin(1, (day - days[at]) / gap) : 1;
    joined[i] = values[at] + share * (values[at + 1] - values[at]);
  }
  const std::string unit = trend.unit == "1" ? "" : " [" + trend.unit + "]";
  SvgPlot plot(trend_title(trend),
               {"days since " + readable_utc(trend.values.front().started_utc), 0, span},
               axis_around(trend.asked.measure + unit, values), width_px, height_px);
  plot.add_trace(0, step, joined);
  if (trend.per_day && trend.per_day->is_told()) {
    // The last of the values alone are the line's if there are more than it takes.
    Eigen::VectorXd middle = days;
    std::sort(middle.data(), middle.data() + count);
    const double centre = (middle[(count - 1) / 2] + middle[count / 2]) / 2 - first;
    Eigen::VectorXd line(grid);
    for (Eigen::Index i = 0; i < grid; ++i) {
      line[i] = trend.per_day->level + trend.per_day->slope * (double(i) * step - centre);
    }
    plot.add_trace(0, step, line, "before");
  }
  return plot.svg();
}

std::string rows_of(const Trend& trend) {
  std::vector<std::vector<std::string>> rows;
  for (const RunValue& value : trend.values) {
    rows.push_back({readable_utc(value.started_utc), xml_escaped(value.serial),
                    xml_escaped(with_unit(value.value, value.unit)), xml_escaped(value.of),
                    std::to_string(value.point), xml_escaped(value.channel),
                    xml_escaped(value.verdict)});
  }
  if (rows.empty()) return "";
  return report::section(
      "The worst of each run",
      report::table({"started (UTC)", "unit", "value", "of", "point", "channel", "verdict"}, rows));
}

}  // namespace

std::string make_trend_page(const Trend& trend) {
  const std::string title = xml_escaped(trend_title(trend));
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         title + "</title>\n<style>\n" + report::style_sheet() +
         "</style></head><body><main>\n<h1>" + title + "</h1>\n" +
         report::paragraph(trend.values.empty() ? "no run has it" : trend_sentence(trend)) +
         plot_of(trend) +
         report::paragraph(
             "The line is that of Theil and Sen, its interval Sen's (1968): widened where "
             "neighbours are alike (Yue & Wang 2004). What moves may be the units, the bench or "
             "its sensors.") +
         rows_of(trend) + "</main></body></html>\n";
}

}  // namespace rvbench::bench
