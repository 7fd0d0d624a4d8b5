#pragma once

#include <optional>
#include <string_view>

namespace rvbench::hal::formats {

/// What stands in some columns of a line, as FORTRAN writes it.
class Columns {
 public:
  explicit Columns(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }

  /// Nothing if it is no whole number, or beyond an int; 0 if it is blank.
  std::optional<int> integer() const;

  /// Nothing if it is no number; 0 if it is blank. "1.5D+03" is 1500, "1.5-101" is 1.5e-101.
  std::optional<double> number() const;

 private:
  std::string_view text_;
};

/// Columns first, first + 1 ... of `line`, which may end before them. The first column is 0.
inline Columns columns(std::string_view line, std::size_t first, std::size_t count) {
  return Columns(first < line.size() ? line.substr(first, count) : std::string_view());
}

/// Takes the next number off `text`, as FORTRAN writes it; blanks before it are passed over, and
/// none is needed where a sign begins the next one: "-1.5E+002-2.5E+002". "NaN" and an infinity
/// are NaN. Nothing, and nothing taken but blanks, if what is next is no number.
std::optional<double> take_fortran_number(std::string_view& text);

}  // namespace rvbench::hal::formats
