#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/formats/table/table_hints.hpp"

namespace rvbench::hal::formats {

/// Where the table of a text stands, and how its cells are parted.
struct TableLayout {
  char separator = ',';        ///< ' ' for blanks, any number of them
  std::size_t first_line = 0;  ///< of samples
  std::size_t columns = 0;
  std::vector<std::string> names;  ///< one a column, empty where the file has none
  std::vector<std::string> units;  ///< of the row below the names; empty if there is none
  std::vector<std::string> above;  ///< lines above the head, without comment marks
  std::size_t head_line = 0;       ///< 0: the table has no names
};

/// Finds the table in the first lines of a text: the longest run of lines of numbers and times with
/// as many cells each. The nearest line of text above it with as many cells is its head, or the
/// row of units below the head; all other lines above are settings.
///
/// @param lines  the first of them, up to `layout_lines`
/// @return the layout, or why there is none
std::variant<TableLayout, std::string> layout_of(const std::vector<std::string_view>& lines,
                                                 const TableHints& hints);

inline constexpr std::size_t layout_lines = 4000;

/// The cells of a line. Nothing if a quote does not end. One blank cell more if the line ends with
/// the separator and has one cell less than asked for.
std::optional<std::vector<std::string_view>> cells_of(std::string_view line, char separator,
                                                      std::size_t columns);

}  // namespace rvbench::hal::formats
