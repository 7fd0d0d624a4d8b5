#include "bench/report/strip_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/report/html.hpp"
#include "bench/report/svg_plot.hpp"

namespace rvbench::bench::report {
namespace {

constexpr double columns = 70;  // dots side by side at most
constexpr int strip_width_px = 540, strip_height_px = 185;

// All that is drawn, with a little air.
PlotAxis value_axis(const Standing& standing) {
  const UnitNumber& number = standing.number;
  double least = number.value, most = number.value;
  const auto hold = [&](double value) {
    least = std::fmin(least, value);  // fmin: of a limit that is not there, nothing
    most = std::fmax(most, value);
  };
  hold(number.limit);
  for (const double value : standing.passed) hold(value);
  for (const double value : standing.failed) hold(value);
  const double air = most > least ? 0.04 * (most - least) : std::fmax(0.1 * std::abs(most), 0.1);
  const char* side = number.worst_is_least ? "higher" : "lower";
  return {fmt::format("{}n = {} earlier units, {} of them {}, median {}",
                      number.unit == "1" ? "" : number.unit + "; ", standing.units(),
                      standing.better, side, report::number(standing.median)),
          least - air, most + air};
}

// Stacks each value on those that are in its column already.
struct Stacks {
  const PlotAxis& axis;
  std::map<int, int> heights = {};

  double put(double value) {
    const double share = (value - axis.min) / (axis.max - axis.min);
    return heights[static_cast<int>(share * columns)]++ + 0.5;
  }
  int tallest() const {
    int most = 0;
    for (const auto& [column, height] : heights) most = std::max(most, height);
    return most;
  }
};

std::vector<double> put_all(Stacks& stacks, const std::vector<double>& values) {
  std::vector<double> heights;
  for (const double value : values) heights.push_back(stacks.put(value));
  return heights;
}

}  // namespace

std::string strip_plot(const Standing& standing) {
  const UnitNumber& number = standing.number;
  const PlotAxis axis = value_axis(standing);
  Stacks stacks{axis};
  const std::vector<double> passed = put_all(stacks, standing.passed);
  const std::vector<double> failed = put_all(stacks, standing.failed);
  SvgPlot plot(name_of(number), axis, {"units", 0, std::max(4.0, stacks.tallest() + 0.5)},
               strip_width_px, strip_height_px);
  plot.add_dots(standing.passed, passed, "passed");
  plot.add_dots(standing.failed, failed, "failed");
  if (std::isfinite(number.limit)) {
    plot.add_mark(number.limit, "limit " + report::number(number.limit));
  }
  plot.add_mark(number.value, "this unit " + report::number(number.value), "own");
  return plot.svg();
}

}  // namespace rvbench::bench::report
