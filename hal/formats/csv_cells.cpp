#include "hal/formats/csv_cells.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/formats/table/number_marks.hpp"

namespace rvbench::hal::formats {
namespace {

// Without blanks at its ends; a tab that parts cells is none.
std::string_view trimmed(std::string_view text, char separator) {
  const auto is_space = [separator](char c) {
    return c == ' ' || c == '\r' || (c == '\t' && separator != '\t');
  };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

// Where the quote that `text` begins with ends; two in a row are one within it.
std::size_t end_of_quote(std::string_view text) {
  std::size_t at = text.find('"', 1);
  while (at != text.npos && text.substr(at).starts_with("\"\"")) at = text.find('"', at + 2);
  return at;
}

}  // namespace

std::optional<char> csv_separator(std::string_view first_line) {
  for (const char separator : {'\t', ';', ','}) {
    bool quoted = false;
    for (const char c : first_line) {
      if (c == '"') quoted = !quoted;
      if (c == separator && !quoted) return separator;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<std::string_view>> csv_cells(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  const std::string_view marks = separator == ' ' ? " \t" : std::string_view(&separator, 1);
  line = trimmed(line, separator);
  while (!line.empty()) {
    std::size_t from = 0;
    if (line.front() == '"') {
      from = end_of_quote(line);
      if (from == line.npos) return std::nullopt;
    }
    const std::size_t end = std::min(line.find_first_of(marks, from), line.size());
    std::string_view cell = trimmed(line.substr(0, end), separator);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
      cell = trimmed(cell.substr(1, cell.size() - 2), separator);
    }
    cells.push_back(cell);
    line.remove_prefix(std::min(end + 1, line.size()));
    while (line.starts_with(' ') || (separator == ' ' && line.starts_with('\t'))) {
      line.remove_prefix(1);
    }
  }
  return cells;
}

std::variant<double, std::string> CsvNumbers::read(std::string_view cell) {
  const std::string_view shown = cell.substr(0, 40);
  const std::size_t comma = cell.find(',');
  const bool has_point = cell.find('.') != cell.npos;
  const std::optional<double> value = written_number(cell, {comma == cell.npos ? '.' : ',', '\0'});
  if (comma != cell.npos && has_point) {
    return fmt::format("\"{}\" is not a number: it has both a comma and a point", shown);
  }
  if (!value) return fmt::format("\"{}\" is not a number", shown);
  const char met = comma != cell.npos ? ',' : has_point ? '.' : '\0';
  if (decimal == '\0') decimal = met;
  if (met == '\0' || met == decimal) return *value;
  return fmt::format("\"{}\" has a decimal {}, numbers before it have a {}", shown,
                     met == ',' ? "comma" : "point", met == ',' ? "point" : "comma");
}

}  // namespace rvbench::hal::formats
