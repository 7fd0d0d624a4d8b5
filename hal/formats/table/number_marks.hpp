#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rvbench::hal::formats {

/// How the numbers of a table are written. It is a property of the table, never of a cell.
struct NumberStyle {
  char decimal = '.';
  char thousands = '\0';  ///< '\0': none
};

/// The number that a cell has written out, "nan" among them; nothing if it has none, or an
/// infinity.
std::optional<double> written_number(std::string_view cell, NumberStyle style);

/// The value of a cell; nothing if it holds no number. A cell that is_lost() is NaN.
std::optional<double> number_in(std::string_view cell, NumberStyle style);

/// Whether a cell may hold a number in some style.
bool may_be_number(std::string_view cell);

/// Whether a cell stands for a lost sample: it is blank, "NA", "NaN", "null", "-", an infinity.
bool is_lost(std::string_view cell);

/// Decides between the styles by all cells of a table.
///
/// A mark before exactly three digits, behind one to three without a leading zero, may part
/// thousands. Cells that contradict each other, and a column that can be read in two ways, are
/// rejected.
class NumberMarks {
 public:
  void add(std::string_view cell, std::size_t line, std::size_t column);

  /// @param separator  of the cells
  /// @param decimal  as the user states it; '\0' if the user does not
  /// @return the style, or why there is none, with the places
  std::variant<NumberStyle, std::string> style(char separator, char decimal) const;

 private:
  struct Place {
    std::size_t line = 0, column = 0;
    std::string cell;

    explicit operator bool() const { return line > 0; }
  };
  struct Mark {
    Place any, grouping, decimal, several;  // the first cell of each kind
  };
  struct Column {
    Place grouping;  // by a comma
    Place whole;     // below 1000, without a mark
  };
  using Answer = std::variant<NumberStyle, std::string>;

  Answer with_commas(char separator) const;
  Answer with_both() const;
  Answer as_stated(char decimal) const;

  Mark points_, commas_;
  std::vector<Column> columns_;
};

}  // namespace rvbench::hal::formats
