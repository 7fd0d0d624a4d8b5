#include "bench/report/svg_plot.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace rvbench::bench {

using Catch::Matchers::Contains;

namespace {

std::string trace_of(const SvgPlot& plot) {
  const std::string svg = plot.svg();
  const std::size_t begin = svg.find("class=\"trace\"");
  return svg.substr(begin, svg.find("/>", begin) - begin);
}

}  // namespace

TEST_CASE("ticks are round and lie on the axis", "[bench]") {
  const auto near = [](const std::vector<double>& ticks, const std::vector<double>& expected) {
    REQUIRE(ticks.size() == expected.size());
    for (std::size_t i = 0; i < ticks.size(); ++i)
      CHECK(ticks[i] == Approx(expected[i]).margin(1e-9));
  };
  near(round_ticks(0, 10, 5), {0, 2, 4, 6, 8, 10});
  near(round_ticks(-0.13, 0.11, 5), {-0.1, -0.05, 0, 0.05, 0.1});
  // Of values that differ in their last digit no steps can be counted.
  near(round_ticks(0.3, std::nextafter(0.3, 1), 5), {0.3});
  near(round_ticks(7, 7, 5), {7});
  near(round_ticks(990, 1040, 5), {990, 1000, 1010, 1020, 1030, 1040});
}

TEST_CASE("one sample's peak in a million stays visible", "[bench]") {
  Eigen::VectorXd flat = Eigen::VectorXd::Zero(1000000);
  SvgPlot without("quiet", {"t", 0, 1}, {"x", -1, 1});
  without.add_trace(0, 1e-6, flat);
  flat[654321] = 1;
  SvgPlot with("peak", {"t", 0, 1}, {"x", -1, 1});
  with.add_trace(0, 1e-6, flat);
  // y = 1 is the upper edge of the frame, 57 px from the top.
  CHECK_THAT(trace_of(with), Contains(",57.0"));
  CHECK_THAT(trace_of(without), !Contains(",57.0"));
  CHECK(with.svg().size() < 40000);
}

TEST_CASE("a gap in the samples is a gap in the trace", "[bench]") {
  Eigen::VectorXd y(4);
  y << 0, 1, std::nan(""), 1;
  SvgPlot plot("gap", {"t", 0, 3}, {"x", 0, 2});
  plot.add_trace(0, 1, y);
  const std::string trace = trace_of(plot);
  CHECK(std::count(trace.begin(), trace.end(), 'M') == 2);
  CHECK_THAT(trace, !Contains("nan"));
}

TEST_CASE("a band is as wide in each column as at its widest", "[bench]") {
  Eigen::VectorXd middle = Eigen::VectorXd::Zero(100000),
                  width = Eigen::VectorXd::Constant(100000, 0.1);
  width[54321] = 1;
  SvgPlot plot("band", {"t", 0, 1}, {"x", -1, 1});
  plot.add_band(0, 1e-5, middle - width, middle + width);
  CHECK_THAT(plot.svg(), Contains("class=\"band\"") && Contains(",57.0"));
  CHECK(plot.svg().size() < 40000);
}

TEST_CASE("groups of bars stand on zero, with their labels in place of the ticks", "[bench]") {
  SvgPlot plot("groups", {"order", 0, 2}, {"x", 0, 2});
  plot.add_groups({{"39/121", {{1, 0.5, 1.5, "measured"}, {2, 0, 0, "before"}}},
                   {"<1>", {{0, 0, 0, "after"}}}});
  const std::string svg = plot.svg();
  // 120 px from zero to the top of the frame.
  CHECK_THAT(svg, Contains("class=\"bar measured\"") && Contains("height=\"60.0\""));
  CHECK_THAT(svg, Contains("class=\"bar before\"") && Contains("height=\"120.0\""));
  CHECK_THAT(svg, Contains("39/121") && Contains("&lt;1&gt;"));
  CHECK_THAT(svg, !Contains(",57V177"));  // a line up from a tick
  const auto whisker = svg.find("class=\"whisker\"");
  CHECK(whisker != std::string::npos);
  CHECK(svg.find("class=\"whisker\"", whisker + 1) == std::string::npos);  // one value is uncertain
}

TEST_CASE("labels are escaped, and marks off the axis are left out", "[bench]") {
  SvgPlot plot("a < b", {"t", 0, 1}, {"x", 0, 1});
  plot.add_mark(0.5, "<here>");
  plot.add_mark(7, "elsewhere");
  CHECK_THAT(plot.svg(), Contains("a &lt; b"));
  CHECK_THAT(plot.svg(), Contains("&lt;here&gt;"));
  CHECK_THAT(plot.svg(), !Contains("elsewhere"));
}

TEST_CASE("an empty axis is the caller's bug", "[bench]") {
  CHECK_THROWS_AS(SvgPlot("", {"t", 1, 1}, {"x", 0, 1}), std::invalid_argument);
  CHECK_THROWS_AS(SvgPlot("", {"t", 0, std::nan("")}, {"x", 0, 1}), std::invalid_argument);
  CHECK(axis_around("x", Eigen::VectorXd::Zero(3)).max > 0);
}

}  // namespace rvbench::bench
