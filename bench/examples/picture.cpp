#include "bench/examples/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bench/report/svg_plot.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {

using namespace analysis::examples;

namespace {

constexpr int width_px = 640, plot_px = 190;
constexpr int empty_px = 34;  // above the title of a plot without marks
constexpr int map_left_px = 64, map_top_px = 26, map_foot_px = 38;
constexpr int map_rows_px = 170, right_px = 626;

constexpr std::array<const char*, 4> styles{"first", "second", "third", "fourth"};

constexpr const char* style_sheet =
    "<style>svg{font:10.5px system-ui,'Liberation Sans',Arial,sans-serif}"
    "text{fill:#1c2530}.mid{text-anchor:middle}.end{text-anchor:end}"
    ".title{font-weight:600;font-size:11.5px}.marklabel{fill:#b3261e;font-size:9.5px}"
    ".grid{stroke:#e6ebef}.frame{fill:none;stroke:#8a97a3}"
    "path.first,path.second,path.third{fill:none;stroke-linejoin:round}"
    "path.first{stroke:#1f5fa8}path.second{stroke:#e08a2e;stroke-width:1.2}"
    "path.third{stroke:#1c2530;stroke-dasharray:4 2}"
    "rect.first,text.first{fill:#1f5fa8}rect.second,text.second{fill:#e08a2e}"
    "rect.third,text.third{fill:#1c2530}rect.fourth,text.fourth{fill:#9fb0bf}"
    ".mark{stroke:#b3261e;stroke-width:.8;stroke-dasharray:3 3;fill:none}</style>";

// White, yellow, red, dark: of so many, that a stretch of one colour is one stroke.
constexpr std::array<const char*, 9> colours{"",        "#fdf2cf", "#fde79f", "#fbc475", "#f9a04b",
                                             "#e46d44", "#ce3a3c", "#902335", "#520c3a"};

struct Drawn {
  std::string svg;
  int height_px = 0;
  int cut_px = 0;  // from the top: nothing is there
};

PlotAxis plot_axis(const Axis& axis) { return {axis.label, axis.min, axis.max}; }

// Names in their colours, at the right, from the last one on.
std::string legend(const std::vector<std::string>& names, int y_px) {
  std::string text;
  double at_px = right_px;
  for (std::size_t i = names.size(); i-- > 0;) {
    text += fmt::format(R"(<text x="{:.0f}" y="{}" class="end {}">{}</text>)", at_px, y_px,
                        styles.at(i), xml_escaped(names[i]));
    at_px -= 6.0 * static_cast<double>(names[i].size()) + 14;
  }
  return text;
}

Drawn draw(const Panel& panel) {
  SvgPlot plot(panel.title, plot_axis(panel.x), plot_axis(panel.y), width_px, plot_px);
  std::vector<std::string> names;
  for (const Trace& trace : panel.traces) {
    plot.add_trace(trace.first, trace.step, trace.values, styles.at(names.size()));
    names.push_back(trace.name);
  }
  for (const Mark& mark : panel.marks) plot.add_mark(mark.at, mark.label);
  const bool has_marks = !panel.marks.empty();
  const int legend_px = has_marks ? 14 : 51;  // where the plot has its title
  return {plot.svg() + (names.size() > 1 ? legend(names, legend_px) : ""), plot_px,
          has_marks ? 0 : empty_px};
}

Drawn draw(const Bars& bars) {
  SvgPlot plot(bars.title, {"", 0, static_cast<double>(bars.groups.size())}, plot_axis(bars.y),
               width_px, plot_px);
  std::vector<PlotGroup> groups;
  for (const Bars::Group& group : bars.groups) {
    PlotGroup side_by_side{group.label, {}};
    for (const double value : group.values) {
      side_by_side.bars.push_back({value, 0, 0, styles.at(side_by_side.bars.size())});
    }
    groups.push_back(std::move(side_by_side));
  }
  plot.add_groups(groups);
  return {plot.svg() + legend(bars.names, 51), plot_px, empty_px};
}

// Strokes along the rows, by colour.
std::string cells(const Map& map, double row_px) {
  std::map<std::size_t, std::string> strokes;
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    const Eigen::VectorXd& row = map.rows[r].cells;
    const double cell_px = double(right_px - map_left_px) / static_cast<double>(row.size());
    const double y_px = map_top_px + map_rows_px - (static_cast<double>(r) + 0.5) * row_px;
    const auto colour_of = [&](Eigen::Index i) {
      const double share = std::clamp(row[i] / map.most, 0.0, 1.0);
      return static_cast<std::size_t>(std::lround(share * (colours.size() - 1)));
    };
    for (Eigen::Index from = 0, to = 0; from < row.size(); from = to) {
      for (to = from + 1; to < row.size() && colour_of(to) == colour_of(from);) ++to;
      strokes[colour_of(from)] +=
          fmt::format("M{:.1f},{:.1f}h{:.1f}", map_left_px + double(from) * cell_px, y_px,
                      double(to - from) * cell_px);
    }
  }
  strokes.erase(0);
  std::string svg;
  for (const auto& [colour, path] : strokes) {
    svg += fmt::format(R"(<path stroke="{}" stroke-width="{:.2f}" d="{}"/>)", colours.at(colour),
                       row_px + 0.2, path);
  }
  return svg;
}

Drawn draw(const Map& map) {
  const double row_px = double(map_rows_px) / static_cast<double>(map.rows.size());
  const int bottom = map_top_px + map_rows_px;
  std::string svg = fmt::format(R"(<text x="{}" y="{}" class="title">{}</text>)", map_left_px,
                                map_top_px - 8, xml_escaped(map.title)) +
                    cells(map, row_px);
  for (const double tick : round_ticks(map.x.min, map.x.max, 8)) {
    const double share = (tick - map.x.min) / (map.x.max - map.x.min);
    svg += fmt::format(R"(<text x="{:.1f}" y="{}" class="mid">{:.6g}</text>)",
                       map_left_px + share * (right_px - map_left_px), bottom + 13, tick + 0.0);
  }
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    svg += fmt::format(R"(<text x="{}" y="{:.1f}" class="end">{}</text>)", map_left_px - 5,
                       bottom - (static_cast<double>(r) + 0.5) * row_px + 3.5,
                       xml_escaped(map.rows[r].label));
  }
  svg += fmt::format(R"(<rect class="frame" x="{}" y="{}" width="{}" height="{}"/>)", map_left_px,
                     map_top_px, right_px - map_left_px, map_rows_px);
  svg += fmt::format(R"(<text x="{}" y="{}" class="mid">{}</text>)", (map_left_px + right_px) / 2,
                     bottom + map_foot_px - 8, xml_escaped(map.x.label));
  svg += fmt::format(R"x(<text transform="translate(13,{}) rotate(-90)" class="mid">{}</text>)x",
                     map_top_px + map_rows_px / 2, xml_escaped(map.y_label));
  return {svg, bottom + map_foot_px, 0};
}

}  // namespace

std::string picture_of(const Example& example) {
  std::string inside;
  int height_px = 0;
  for (const auto& plot : example.plots) {
    const Drawn drawn = std::visit([](const auto& each) { return draw(each); }, plot);
    // A nested <svg> fills what is around it, unless told otherwise.
    std::string svg = drawn.svg;
    if (svg.starts_with("<svg ")) {
      svg.insert(5, fmt::format("width=\"{}\" height=\"{}\" ", width_px, drawn.height_px));
    }
    inside +=
        fmt::format("<g transform=\"translate(0,{})\">{}</g>\n", height_px - drawn.cut_px, svg);
    height_px += drawn.height_px - drawn.cut_px;
  }
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" )"
                     R"(height="{1}">)",
                     width_px, height_px) +
         style_sheet + "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + inside +
         "</svg>\n";
}

}  // namespace rvbench::bench
