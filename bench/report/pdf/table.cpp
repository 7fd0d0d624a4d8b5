#include "bench/report/pdf/table.hpp"

#include <algorithm>
#include <numeric>

namespace rvbench::bench::pdf {
namespace {

using TableRow = std::vector<std::string>;

constexpr double column_gap_pt = 8;
constexpr double air_pt = 1.5;    // above and below the text of a row
constexpr int unbroken_rows = 8;  // a row of as many lines is kept on one page

// What each column would take if it had all the room it wants.
std::vector<double> wanted_widths_pt(const Typesetter& typesetter, const Table& table,
                                     const TextStyle& style) {
  std::size_t count = table.head.size();
  for (const TableRow& row : table.rows) count = std::max(count, row.size());
  std::vector<double> widths_pt(count, 0);
  const auto widen = [&](const TableRow& row, const TextStyle& in) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths_pt[c] = std::max(widths_pt[c], typesetter.width_pt(row[c], in) + column_gap_pt);
    }
  };
  TextStyle bold = style;
  bold.bold = true;
  widen(table.head, bold);
  for (const TableRow& row : table.rows) widen(row, style);
  return widths_pt;
}

// Narrow columns get what they want; the others share the rest alike.
std::vector<double> shared_out(std::vector<double> wanted_pt, double width_pt) {
  if (std::accumulate(wanted_pt.begin(), wanted_pt.end(), 0.0) <= width_pt) return wanted_pt;
  std::vector<double> ascending = wanted_pt;
  std::ranges::sort(ascending);
  double left_pt = width_pt, share_pt = 0;
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    share_pt = left_pt / static_cast<double>(ascending.size() - i);
    if (ascending[i] > share_pt) break;
    left_pt -= ascending[i];
  }
  for (double& one_pt : wanted_pt) one_pt = std::min(one_pt, share_pt);
  return wanted_pt;
}

struct Layout {
  const Typesetter& typesetter;
  std::vector<double> widths_pt;
  bool ruled = false;

  double width_pt() const { return std::accumulate(widths_pt.begin(), widths_pt.end(), 0.0); }

  // One block per line of text, across all columns.
  Blocks row(const TableRow& cells, const TextStyle& style, const char* ground) const {
    std::vector<std::vector<TextLine>> columns;
    std::size_t count = 1;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      columns.push_back(typesetter.lines(cells[c], style, widths_pt[c] - column_gap_pt));
      count = std::max(count, columns.back().size());
    }
    Blocks blocks;
    for (std::size_t k = 0; k < count; ++k) {
      blocks.push_back(line(columns, k, count, ground));
      blocks.back().keeps_next = k + 1 < count && count <= unbroken_rows;
    }
    return blocks;
  }

 private:
  Block line(const std::vector<std::vector<TextLine>>& columns, std::size_t k, std::size_t count,
             const char* ground) const {
    const double above_pt = k == 0 ? air_pt : 0;
    const double below_pt = k + 1 == count ? air_pt : 0;
    double text_pt = 0;
    std::vector<std::pair<double, TextLine>> pieces;
    double x_pt = column_gap_pt / 2;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (k < columns[c].size()) {
        pieces.emplace_back(x_pt, columns[c][k]);
        text_pt = std::max(text_pt, columns[c][k].height_pt);
      }
      x_pt += widths_pt[c];
    }
    const double height_pt = above_pt + text_pt + below_pt;
    const double across_pt = width_pt();
    const bool rule = ruled && k == 0;
    return {height_pt, [=](cairo_t* page, double left_pt, double top_pt) {
              if (ground != nullptr) fill_box(page, ground, left_pt, top_pt, across_pt, height_pt);
              if (rule) fill_box(page, colours::line, left_pt, top_pt, across_pt, 0.5);
              for (const auto& [at_pt, text] : pieces) {
                text.draw(page, left_pt + at_pt, top_pt + above_pt);
              }
            }};
  }
};

}  // namespace

Blocks table_blocks(const Typesetter& typesetter, const Table& table, const TextStyle& style,
                    double width_pt) {
  const std::vector<double> wanted_pt = wanted_widths_pt(typesetter, table, style);
  if (wanted_pt.empty()) return {};
  const bool has_head = !table.head.empty();
  const Layout layout{typesetter, shared_out(wanted_pt, width_pt), has_head};
  Blocks blocks;
  std::shared_ptr<const Blocks> head;
  if (has_head) {
    TextStyle bold = style;
    bold.bold = true;
    blocks = layout.row(table.head, bold, colours::head);
    for (Block& block : blocks) block.keeps_next = true;
    head = std::make_shared<const Blocks>(blocks);
  }
  for (const TableRow& row : table.rows) {
    Blocks lines = layout.row(row, style, nullptr);
    for (Block& line : lines) line.head = head;
    append(blocks, lines);
  }
  return blocks;
}

}  // namespace rvbench::bench::pdf
