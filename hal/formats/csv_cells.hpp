#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rvbench::hal::formats {

/// What parts the cells of a table in text, by its first line: a tab, a semicolon or a comma that
/// is not within quotes; nothing if there is none of them.
std::optional<char> csv_separator(std::string_view first_line);

/// The cells of one line, without the blanks and quotes around them. A separator at the line's end
/// adds none. The separator ' ' stands for any number of blanks and tabs. Nothing if a quote does
/// not end.
std::optional<std::vector<std::string_view>> csv_cells(std::string_view line, char separator);

/// How the numbers of a table are written, as far as any of them has shown it.
struct CsvNumbers {
  char decimal = '\0';  ///< '.' or ',': the first that was met

  /// "nan" is a number, for it marks a lost sample, but an infinity is none.
  /// @return the number, or why it is none: `"x7" is not a number`
  std::variant<double, std::string> read(std::string_view cell);
};

}  // namespace rvbench::hal::formats
