#pragma once

#include <string>
#include <vector>

#include "bench/report/pdf/block.hpp"
#include "bench/report/pdf/typesetter.hpp"

namespace rvbench::bench::pdf {

/// Cells are markup. Rows may be shorter than the head.
struct Table {
  std::vector<std::string> head;  ///< empty: none, and no lines between the rows
  std::vector<std::vector<std::string>> rows;
};

/// A table over at most that width. Each line of text is a block, so that no row, however high, is
/// cut off at the foot of a page; its head is there again on the next page.
Blocks table_blocks(const Typesetter& typesetter, const Table& table, const TextStyle& style,
                    double width_pt);

}  // namespace rvbench::bench::pdf
