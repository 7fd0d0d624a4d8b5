#include "bench/report/pdf/matrix_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "bench/report/matrix_cell.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::pdf {
namespace {

using report::MatrixCell;
using Row = std::map<double, std::vector<MatrixCell>>;  // by speed, repeats in their order

constexpr double label_pt = 38;  // left of the boxes
constexpr double most_row_pt = 14, most_height_pt = 86, most_box_pt = 40;
constexpr double least_text_box_pt = 17, least_text_row_pt = 8;
const TextStyle small{.size_pt = 6.5};
const TextStyle faint{.size_pt = 6.5, .colour = colours::faint};

struct Matrix {
  std::set<double> speeds_rpm;
  std::map<double, Row, std::greater<>> rows;  // by load, the highest on top
  std::size_t repeats = 1;                     // at most
};

Matrix matrix_of(const ReportInput& input) {
  Matrix matrix;
  for (const JudgedPoint& point : input.judgement.points) {
    const double load_pct = point.examination.load_pct;
    if (!std::isfinite(point.planned_speed_rpm) || !std::isfinite(load_pct)) continue;
    matrix.speeds_rpm.insert(point.planned_speed_rpm);
    auto& cells = matrix.rows[load_pct][point.planned_speed_rpm];
    cells.push_back(report::matrix_cell(point, input.kinematics));
    matrix.repeats = std::max(matrix.repeats, cells.size());
  }
  return matrix;
}

const char* ground_of(std::string_view level) {
  if (level == "low") return "#cfead6";
  if (level == "mid-level") return "#fff0b8";
  if (level == "high") return "#f3b3ad";
  return level == "spoiled" ? "#dddddd" : "#ffffff";
}

void hatch(cairo_t* page, double x_pt, double y_pt, double width_pt, double height_pt) {
  cairo_save(page);
  cairo_rectangle(page, x_pt, y_pt, width_pt, height_pt);
  cairo_clip(page);
  use_colour(page, "#ffffff");
  cairo_set_line_width(page, 1.2);
  for (double at_pt = -height_pt; at_pt < width_pt; at_pt += 4) {
    cairo_move_to(page, x_pt + at_pt, y_pt + height_pt);
    cairo_line_to(page, x_pt + at_pt + height_pt, y_pt);
  }
  cairo_stroke(page);
  cairo_restore(page);
}

// Where boxes lie and how large they are.
struct Grid {
  const Typesetter& typesetter;
  double column_pt, box_pt, row_pt;

  void draw_box(cairo_t* page, const MatrixCell& cell, double x_pt, double y_pt) const {
    const double width_pt = box_pt - 1, height_pt = row_pt - 1;
    fill_box(page, ground_of(cell.level), x_pt, y_pt, width_pt, height_pt);
    if (cell.level == "spoiled") hatch(page, x_pt, y_pt, width_pt, height_pt);
    use_colour(page, cell.level == "high" ? colours::bad : "#b5bfc8");
    cairo_set_line_width(page, cell.level == "high" ? 1 : 0.4);
    cairo_rectangle(page, x_pt, y_pt, width_pt, height_pt);
    cairo_stroke(page);
    if (box_pt < least_text_box_pt || row_pt < least_text_row_pt) return;
    TextStyle style = small;
    style.bold = cell.level == "high";
    const auto text = typesetter.lines(xml_escaped(cell.text), style, width_pt, 1);
    text.front().draw(page, x_pt + std::max(0.0, (width_pt - text.front().width_pt) / 2),
                      y_pt + (height_pt - text.front().height_pt) / 2);
  }
};

Block row_block(const Grid& grid, const std::set<double>& speeds_rpm, double load_pct,
                const Row& row) {
  std::vector<TextLine> label;
  if (grid.row_pt >= least_text_row_pt) {
    label = grid.typesetter.lines(fmt::format("{:.4g} %", load_pct), small, label_pt, 1);
  }
  return {grid.row_pt, [=](cairo_t* page, double x_pt, double y_pt) {
            if (!label.empty()) label.front().draw(page, x_pt, y_pt + 1);
            double column_at_pt = x_pt + label_pt;
            for (const double speed : speeds_rpm) {
              double box_at_pt = column_at_pt;
              const auto found = row.find(speed);
              if (found != row.end()) {
                for (const MatrixCell& cell : found->second) {
                  grid.draw_box(page, cell, box_at_pt, y_pt);
                  box_at_pt += grid.box_pt;
                }
              }
              column_at_pt += grid.column_pt;
            }
          }};
}

Block head_block(const Grid& grid, const std::set<double>& speeds_rpm) {
  std::vector<TextLine> heads;
  for (const double speed : speeds_rpm) {
    heads.push_back(
        grid.typesetter.lines(fmt::format("{:.4g} rpm", speed), faint, grid.column_pt, 1).front());
  }
  return {10, [=](cairo_t* page, double x_pt, double y_pt) {
            for (std::size_t i = 0; i < heads.size(); ++i) {
              heads[i].draw(page, x_pt + label_pt + grid.column_pt * double(i), y_pt);
            }
          }};
}

}  // namespace

Blocks matrix_blocks(const Typesetter& typesetter, const ReportInput& input, double width_pt) {
  const Matrix matrix = matrix_of(input);
  if (matrix.speeds_rpm.empty()) return {};
  const double room_pt = (width_pt - label_pt) / double(matrix.speeds_rpm.size());
  const double box_pt = std::min(most_box_pt, (room_pt - 4) / double(matrix.repeats));
  const double column_pt = std::min(room_pt, std::max(box_pt * double(matrix.repeats) + 8, 44.0));
  const double row_pt = std::min(most_row_pt, most_height_pt / double(matrix.rows.size()));
  const Grid grid{typesetter, column_pt, box_pt, row_pt};
  Blocks blocks{head_block(grid, matrix.speeds_rpm)};
  for (const auto& [load_pct, row] : matrix.rows) {
    blocks.push_back(row_block(grid, matrix.speeds_rpm, load_pct, row));
  }
  append(blocks, typesetter.text("Worst modulation depth of each record over its limit; hatched: "
                                 "not to be trusted; white: not recorded, or a loop",
                                 faint, width_pt, 2));
  return blocks;
}

}  // namespace rvbench::bench::pdf
