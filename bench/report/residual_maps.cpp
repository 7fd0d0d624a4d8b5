#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/explanation_sections.hpp"
#include "bench/report/heat_colour.hpp"
#include "bench/report/html.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_columns = 40;
constexpr double width_px = 540, left_px = 128, right_px = 8, top_px = 22, foot_px = 48;
constexpr double all_rows_px = 420, least_row_px = 7, most_row_px = 24, label_px = 10;
constexpr int legend_cells = 40;

struct MapRow {
  std::string label;
  Eigen::VectorXd before, after;  // size of what is left over, one for each column; or NaN
};

struct ResidualMap {
  std::string channel, unit, over;
  std::vector<std::string> columns;  // labels; empty: none
  std::vector<MapRow> rows;
  double largest = 0;
  bool has_gaps = false;
};

// NaN where either is not known, or a simulation went beyond all numbers.
Eigen::VectorXd left_over_of(const Twin::Comparison& one) {
  return (one.measured - one.simulated).cwiseAbs().unaryExpr([](double size) {
    return std::isfinite(size) ? size : not_known;
  });
}

// Small ones are to be seen beside large ones.
double share_of(double size, double largest) { return largest > 0 ? std::sqrt(size / largest) : 0; }

Eigen::VectorXd by_blocks(const Eigen::VectorXd& left_over) {
  const Eigen::Index size = left_over.size();
  const auto count = std::min<Eigen::Index>(most_columns, size);
  Eigen::VectorXd blocks(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index from = size * i / count, to = size * (i + 1) / count;
    blocks[i] = std::sqrt(left_over.segment(from, to - from).squaredNorm() / double(to - from));
  }
  return blocks;
}

// Sizes at the orders that have most of it in any record; a record may show fewer orders.
void choose_orders(const std::vector<Twin::Comparison>& of, ResidualMap& map) {
  Eigen::Index longest = 0;
  for (const MapRow& row : map.rows) longest = std::max(longest, row.before.size());
  Eigen::VectorXd most = Eigen::VectorXd::Constant(longest, not_known);
  for (const MapRow& row : map.rows) {
    const Eigen::Index own = row.before.size();
    most.head(own) = larger_of(larger_of(most.head(own), row.before), row.after);
  }
  const std::vector<Eigen::Index> chosen = strongest(most, most_columns);
  for (MapRow& row : map.rows) {
    const auto at = [&](const Eigen::VectorXd& sizes) {
      Eigen::VectorXd some =
          Eigen::VectorXd::Constant(static_cast<Eigen::Index>(chosen.size()), not_known);
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i] < sizes.size()) some[Eigen::Index(i)] = sizes[chosen[i]];
      }
      return some;
    };
    row.before = at(row.before);
    row.after = at(row.after);
  }
  const double period = 1 / of.front().step;
  for (const Eigen::Index k : chosen) map.columns.push_back(fmt::format("{}", k + 1));
  map.over = fmt::format("order of the input shaft x {:.6g}", period);
}

ResidualMap map_of(const Comparisons& comparisons, const std::string& channel, bool by_orders) {
  ResidualMap map;
  map.channel = channel;
  map.over = "from the beginning to the end of the record";
  for (std::size_t i = 0; i < comparisons.before.size(); ++i) {
    const Twin::Comparison &b = comparisons.before[i], &a = comparisons.after[i];
    if (b.channel != channel) continue;
    map.unit = b.unit;
    if (!b.over.starts_with("time")) {
      map.over = fmt::format("{}: {:.4g} to {:.4g}", b.over, b.first,
                             b.first + b.step * static_cast<double>(b.measured.size()));
    }
    const Eigen::VectorXd before = left_over_of(b), after = left_over_of(a);
    map.rows.push_back(
        {b.record, by_orders ? before : by_blocks(before), by_orders ? after : by_blocks(after)});
  }
  if (by_orders) choose_orders(comparisons.before, map);
  for (const MapRow& row : map.rows) {
    for (const Eigen::VectorXd* sizes : {&row.before, &row.after}) {
      map.largest = std::fmax(map.largest, sizes->maxCoeff<Eigen::PropagateNumbers>());
      map.has_gaps = map.has_gaps || sizes->hasNaN();
    }
  }
  return map;
}

std::string row_svg(const ResidualMap& map, const Eigen::VectorXd& sizes, double y_px,
                    double row_px) {
  std::string svg;
  const double cell_px = (width_px - left_px - right_px) / static_cast<double>(sizes.size());
  for (Eigen::Index i = 0; i < sizes.size(); ++i) {
    svg += fmt::format(
        R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"/>)",
        left_px + static_cast<double>(i) * cell_px, y_px, cell_px + 0.3, row_px + 0.3,
        std::isnan(sizes[i]) ? "#e4e9ed" : heat_colour(share_of(sizes[i], map.largest)));
  }
  return svg;
}

std::string column_labels(const ResidualMap& map, double bottom_px) {
  std::string svg = fmt::format(R"(<text x="{:.1f}" y="{:.1f}" class="mid">{}</text>)",
                                (left_px + width_px - right_px) / 2, bottom_px + foot_px - 6,
                                xml_escaped(map.over));
  const double cell_px =
      (width_px - left_px - right_px) / std::max(1.0, static_cast<double>(map.columns.size()));
  for (std::size_t i = 0; i < map.columns.size(); ++i) {
    svg += fmt::format(
        R"x(<text transform="translate({:.1f},{:.1f}) rotate(-90)" class="end small">{}</text>)x",
        left_px + (static_cast<double>(i) + 0.5) * cell_px + 3, bottom_px + 4, map.columns[i]);
  }
  return svg;
}

std::string map_svg(const ResidualMap& map, const std::string& title,
                    Eigen::VectorXd MapRow::*sizes) {
  const auto count = static_cast<double>(map.rows.size());
  const double row_px = std::clamp(all_rows_px / count, least_row_px, most_row_px);
  const double bottom_px = top_px + count * row_px;
  const auto every = static_cast<std::size_t>(std::ceil(label_px / row_px));
  std::string svg =
      fmt::format(R"(<svg viewBox="0 0 {:.0f} {:.0f}" role="img" aria-label="{}">)"
                  R"(<text x="{}" y="14" class="title">{}</text>)",
                  width_px, bottom_px + foot_px, xml_escaped(title), left_px, xml_escaped(title));
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    const double y_px = top_px + static_cast<double>(r) * row_px;
    svg += row_svg(map, map.rows[r].*sizes, y_px, row_px);
    if (r % every != 0) continue;
    svg += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" class="end small">{}</text>)", left_px - 4,
                       y_px + std::min(row_px, label_px) / 2 + 3, xml_escaped(map.rows[r].label));
  }
  svg += fmt::format(R"(<rect class="frame" x="{}" y="{}" width="{}" height="{:.1f}"/>)", left_px,
                     top_px, width_px - left_px - right_px, bottom_px - top_px);
  return svg + column_labels(map, bottom_px) + "</svg>\n";
}

std::string legend(const ResidualMap& map) {
  std::string cells;
  for (int i = 0; i < legend_cells; ++i) {
    cells += "<i style=\"background:" + heat_colour((i + 0.5) / legend_cells) + "\"></i>";
  }
  return fmt::format(
      "<div class=\"scale\"><span>0</span>{}<span>{} {}</span></div><p class=\"note\">{}: size of "
      "measured minus simulated; both maps on this scale, which runs with the root{}.</p>\n",
      cells, number(map.largest), xml_escaped(map.unit), xml_escaped(map.channel),
      map.has_gaps ? "; grey: the record does not tell" : "");
}

}  // namespace

std::string residual_maps_section(const Comparisons& comparisons) {
  std::vector<std::string> channels;
  for (const Twin::Comparison& one : comparisons.before) {
    if (std::ranges::find(channels, one.channel) == channels.end()) channels.push_back(one.channel);
  }
  std::string body;
  for (const std::string& channel : channels) {
    const ResidualMap map = map_of(comparisons, channel, comparisons.before.front().is_by_orders());
    body += "<div class=\"figures\">" + map_svg(map, "the plant as it was", &MapRow::before) +
            map_svg(map, "with what was left out", &MapRow::after) + "</div>\n" + legend(map);
  }
  return section("What is left over, record by record", body);
}

}  // namespace rvbench::bench::report
