#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/formats/table/clock_cells.hpp"
#include "hal/formats/table/layout.hpp"
#include "hal/formats/table/number_marks.hpp"

namespace rvbench::hal::formats {

/// A table of a text: its columns of numbers, and when its rows were taken if columns of dates and
/// times say so.
struct Table {
  struct Column {
    std::string name;         ///< empty if it has none
    std::string unit;         ///< of the row of units; empty if there is none
    Eigen::VectorXd samples;  ///< NaN where a cell is_lost()
  };
  std::vector<Column> columns;
  std::optional<ClockRows> clock;
  TableLayout layout;
  NumberStyle numbers;
  std::size_t half_line = 0;  ///< the first whose second cell begins with 0: "05"
};

/// Reads the table of a text, or says with its line why there is none.
std::variant<Table, std::string> read_table(std::string_view text, const TableHints& hints);

}  // namespace rvbench::hal::formats
