#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/report/explanation_sections.hpp"
#include "bench/report/html.hpp"
#include "bench/report/svg_plot.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_lines = 12;
constexpr int wide_px = 980;
constexpr int high_px = 240;

double end_of(const Twin::Comparison& one) {
  return one.first + static_cast<double>(one.measured.size()) * one.step;
}

// All of what is drawn, for an axis that holds it.
Eigen::VectorXd drawn(const UnseenRecord& record) {
  Eigen::VectorXd all(3 * record.before.measured.size());
  all << record.before.measured, record.before.simulated, record.after.simulated;
  return all;
}

std::string title_of(const UnseenRecord& record) {
  return fmt::format("{}: off by {} % before, {} % after", record.before.record,
                     number(100 * record.before.relative_error()),
                     number(100 * record.after.relative_error()));
}

std::string signal_plot(const UnseenRecord& record) {
  const Twin::Comparison& b = record.before;
  SvgPlot plot(title_of(record), {b.over, b.first, end_of(b)},
               axis_around(b.channel + " [" + b.unit + "]", drawn(record)), wide_px, high_px);
  if (record.scatter.size() > 0) {
    plot.add_band(b.first, b.step, b.measured - record.scatter, b.measured + record.scatter);
  }
  plot.add_trace(b.first, b.step, b.measured, "measured");
  plot.add_trace(b.first, b.step, b.simulated, "before");
  plot.add_trace(b.first, b.step, record.after.simulated, "after");
  return plot.svg();
}

// "1560/121", or "3" where the shaft's turn is the period.
std::string short_order(Eigen::Index number, double period) {
  return period > 1.5 ? fmt::format("{}/{:.0f}", number, period) : fmt::format("{}", number);
}

// The strongest lines of one record, as groups of three bars.
std::string line_plot(const UnseenRecord& record) {
  const Twin::Comparison& b = record.before;
  const Eigen::VectorXd largest =
      larger_of(larger_of(b.measured, b.simulated), record.after.simulated);
  std::vector<PlotGroup> groups;
  for (const Eigen::Index k : strongest(largest, most_lines)) {
    const double scatter = record.scatter.size() > 0 ? record.scatter[k] : 0;
    groups.push_back(
        {short_order(k + 1, 1 / b.step),
         {{b.measured[k], b.measured[k] - scatter, b.measured[k] + scatter, "measured"},
          {b.simulated[k], 0, 0, "before"},
          {record.after.simulated[k], 0, 0, "after"}}});
  }
  SvgPlot plot(title_of(record), {b.over, 0, static_cast<double>(groups.size())},
               axis_around(b.channel + " [" + b.unit + "]", largest), wide_px, high_px);
  plot.add_groups(groups);
  return plot.svg();
}

std::string key(const std::string& style, const std::string& means) {
  return "<span><i class=\"" + style + "\"></i>" + means + "</span> ";
}

}  // namespace

Eigen::VectorXd larger_of(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.binaryExpr(b, [](double one, double other) { return std::fmax(one, other); });
}

std::vector<Eigen::Index> strongest(const Eigen::VectorXd& of, std::size_t most) {
  const auto size_at = [&](Eigen::Index k) { return std::isnan(of[k]) ? -HUGE_VAL : of[k]; };
  std::vector<Eigen::Index> order(static_cast<std::size_t>(of.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto count = std::min(most, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](Eigen::Index a, Eigen::Index b) { return size_at(a) > size_at(b); });
  order.resize(count);
  std::ranges::sort(order);
  return order;
}

std::string overlays_section(const Comparisons& comparisons) {
  if (comparisons.unseen.empty()) return {};
  const bool has_scatter = std::ranges::any_of(
      comparisons.unseen, [](const UnseenRecord& one) { return one.scatter.size() > 0; });
  std::string body = "<p class=\"legend\">" + key("measured", "measured") +
                     (has_scatter ? key("band", "nine in ten repeats") : "") +
                     key("before", "the plant as it was") + key("after", "with what was left out") +
                     "</p>\n";
  const bool by_orders = comparisons.unseen.front().before.is_by_orders();
  for (const UnseenRecord& record : comparisons.unseen) {
    body += "<figure class=\"wide\">" + (by_orders ? line_plot(record) : signal_plot(record)) +
            "</figure>\n";
  }
  return section("Measured, and predicted without having been seen",
                 body + paragraph("Both plants were fitted without the condition that is shown" +
                                  std::string(by_orders ? "; lines are amplitudes, the strongest "
                                                          "of each record."
                                                        : ".")));
}

}  // namespace rvbench::bench::report
