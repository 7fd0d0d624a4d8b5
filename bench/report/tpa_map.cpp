#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/heat_colour.hpp"
#include "bench/report/html.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/report/tpa_sections.hpp"
#include "bench/tpa_text.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

using Eigen::Index;
using Places = std::vector<DegreeOfFreedom>;

constexpr Index most_map_columns = 120;
constexpr double map_width_px = 540, map_left_px = 44, map_right_px = 14, map_top_px = 22,
                 map_row_px = 11, map_foot_px = 34;
constexpr double range_dB = 40;  // from the largest down to white
constexpr int colours = 16;

// Largest amplitude of each path at a target, by columns of lines: paths x columns.
Eigen::MatrixXd largest_by_columns(const analysis::PathContributions& contributions, Index target) {
  const Index lines = contributions.grid.lines, columns = std::min(most_map_columns, lines);
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(contributions.forces.rows, columns);
  for (Index line = 0; line < lines; ++line) {
    const Eigen::VectorXd amplitudes =
        contributions.partial(line, target).cwiseAbs2().rowwise().mean().cwiseSqrt();
    auto column = largest.col(line * columns / lines);
    column = column.cwiseMax(amplitudes);
  }
  return largest;
}

int colour_of(double amplitude, double largest) {
  if (!(amplitude > 0)) return 0;
  const double share = 1 + 20 * std::log10(amplitude / largest) / range_dB;
  return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * colours));
}

// Neighbours of one colour are one rectangle; white ones are none.
std::string row_svg(const Eigen::RowVectorXd& amplitudes, double largest, double y_px) {
  const double cell_px = (map_width_px - map_left_px - map_right_px) / double(amplitudes.size());
  std::string svg;
  for (Index i = 0; i < amplitudes.size();) {
    const int colour = colour_of(amplitudes[i], largest);
    Index end = i + 1;
    while (end < amplitudes.size() && colour_of(amplitudes[end], largest) == colour) ++end;
    if (colour > 0) {
      svg +=
          fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"/>)",
                      map_left_px + double(i) * cell_px, y_px, double(end - i) * cell_px + 0.2,
                      map_row_px, heat_colour(double(colour) / colours));
    }
    i = end;
  }
  return svg;
}

// What a map shows of a target: paths x columns, and what the columns run over.
struct PathMap {
  std::string title;
  Eigen::MatrixXd amplitudes;
  std::string axis;
  double first = 0, last = 0;
};

std::string axis_svg(const PathMap& map, double bottom_px) {
  std::string svg;
  for (const double tick : round_ticks(map.first, map.last, 8)) {
    const double x_px = map_left_px + (tick - map.first) / (map.last - map.first) *
                                          (map_width_px - map_left_px - map_right_px);
    svg += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" class="mid">{:g}</text>)", x_px,
                       bottom_px + 13, tick);
  }
  return svg + fmt::format(R"(<text x="{:.1f}" y="{:.1f}" class="mid">{}</text>)",
                           (map_left_px + map_width_px - map_right_px) / 2,
                           bottom_px + map_foot_px - 6, map.axis);
}

std::string map_svg(const PathMap& map, const Places& paths, const std::string& unit) {
  const double largest = map.amplitudes.maxCoeff<Eigen::PropagateNumbers>();
  const double bottom_px = map_top_px + map_row_px * double(map.amplitudes.rows());
  const std::string title = fmt::format("{}, dark: {} {}", map.title, number(largest), unit);
  std::string svg = fmt::format(R"(<svg viewBox="0 0 {:.0f} {:.0f}" role="img" aria-label="{}">)"
                                R"(<text x="{}" y="14" class="title">{}</text>)",
                                map_width_px, bottom_px + map_foot_px, xml_escaped(title),
                                map_left_px, xml_escaped(title));
  for (Index path = 0; path < map.amplitudes.rows(); ++path) {
    const double y_px = map_top_px + map_row_px * double(path);
    svg +=
        row_svg(map.amplitudes.row(path), largest, y_px) +
        fmt::format(R"(<text x="{:.1f}" y="{:.1f}" class="end small">{}</text>)", map_left_px - 4,
                    y_px + map_row_px - 2.5, xml_escaped(path_label(path, paths)));
  }
  svg +=
      fmt::format(R"(<rect class="frame" x="{}" y="{}" width="{}" height="{:.1f}"/>)", map_left_px,
                  map_top_px, map_width_px - map_left_px - map_right_px, bottom_px - map_top_px);
  return svg + axis_svg(map, bottom_px) + "</svg>\n";
}

}  // namespace

std::string frequency_maps(const MotionAnswer& motion, const std::string& unit) {
  const analysis::PathContributions& found = motion.contributions;
  if (found.grid.lines < 2) return "";
  std::string maps;
  for (std::size_t i = 0; i < found.targets.size(); ++i) {
    maps += map_svg(
        {target_name(Index(i), found.targets), largest_by_columns(found, Index(i)),
         "frequency [Hz]", found.grid.first_Hz, found.grid.frequency_Hz(found.grid.lines - 1)},
        found.paths, unit);
  }
  return "<h3>Contributions over frequency</h3>\n<div class=\"figures\">" + maps + "</div>\n" +
         paragraph(fmt::format("Amplitudes, mean in power over the blocks, the largest of the "
                               "lines in a column. White: {:g} dB below the darkest and less, or "
                               "lines left out.",
                               range_dB));
}

std::string time_maps(const MotionAnswer& motion, const std::string& unit) {
  if (!motion.over_time) return "";
  const ContributionsOverTime& over_time = *motion.over_time;
  std::string maps;
  for (std::size_t i = 0; i < over_time.rms.size(); ++i) {
    maps += map_svg({target_name(Index(i), motion.contributions.targets), over_time.rms[i],
                     "time [s]", 0, over_time.duration_s},
                    motion.contributions.paths, unit);
  }
  return "<h3>Contributions over time</h3>\n<div class=\"figures\">" + maps + "</div>\n" +
         paragraph(fmt::format(
             "RMS of the histories, which filters of the same inverse and FRFs make of the "
             "record. They reach {:.2g} s back and {:.2g} s ahead, where the record begins from "
             "rest and ends; what they cut off is {:.1g} of their energy.",
             over_time.reach_back_s, over_time.reach_ahead_s, over_time.cut_share));
}

}  // namespace rvbench::bench::report
