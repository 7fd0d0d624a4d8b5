#pragma once

#include <cairo.h>

#include <functional>
#include <memory>
#include <vector>

namespace rvbench::bench::pdf {

/// A piece of a page that is drawn whole.
struct Block {
  double height_pt = 0;
  std::function<void(cairo_t* page, double x_pt, double y_pt)>
      draw;                 ///< from its upper left corner
  bool keeps_next = false;  ///< no page ends after it
  /// Drawn above it once more where it is the first of a page: the head of its table.
  std::shared_ptr<const std::vector<Block>> head = nullptr;
};

using Blocks = std::vector<Block>;

inline Block space(double height_pt) { return {height_pt, nullptr}; }

inline void append(Blocks& blocks, const Blocks& more) {
  blocks.insert(blocks.end(), more.begin(), more.end());
}

inline double height_pt(const Blocks& blocks) {
  double sum_pt = 0;
  for (const Block& block : blocks) sum_pt += block.height_pt;
  return sum_pt;
}

/// Draws them below each other.
inline void draw_all(const Blocks& blocks, cairo_t* page, double x_pt, double y_pt) {
  for (const Block& block : blocks) {
    if (block.draw) block.draw(page, x_pt, y_pt);
    y_pt += block.height_pt;
  }
}

}  // namespace rvbench::bench::pdf
