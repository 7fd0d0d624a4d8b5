#include "hal/formats/table/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/formats/table/text.hpp"

namespace rvbench::hal::formats {
namespace {

using Cells = std::vector<std::string_view>;
using Fault = std::optional<std::string>;

std::vector<std::string_view> first_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  Lines all(text);
  while (lines.size() < layout_lines && all.next()) lines.push_back(all.line());
  return lines;
}

// Calls `take` with the cells of each row and its line.
template <typename Take>
Fault for_each_row(std::string_view text, const TableLayout& layout, Take take) {
  Lines lines(text);
  std::size_t blank_line = 0;
  while (lines.next()) {
    if (lines.number() < layout.first_line) continue;
    if (is_blank(lines.line())) {
      if (blank_line == 0) blank_line = lines.number();
      continue;
    }
    if (blank_line > 0) return fmt::format("{}: a blank line, and samples behind it", blank_line);
    const auto cells = cells_of(lines.line(), layout.separator, layout.columns);
    if (!cells) return fmt::format("{}: a quote that does not end", lines.number());
    if (cells->size() != layout.columns) {
      return fmt::format("{}: {} values, not {}", lines.number(), cells->size(), layout.columns);
    }
    if (Fault fault = take(*cells, lines.number())) return fault;
  }
  return std::nullopt;
}

// Whether a comma can stand within a cell.
bool may_have_commas(std::string_view text, char separator) {
  return text.find(separator == ',' ? '"' : ',') != text.npos;
}

class TableReader {
 public:
  TableReader(std::string_view text, const TableHints& hints) : text_(text), hints_(hints) {}

  std::variant<Table, std::string> read() {
    const std::vector<std::string_view> lines = first_lines(text_);
    auto layout = layout_of(lines, hints_);
    if (const auto* fault = std::get_if<std::string>(&layout)) return *fault;
    table_.layout = std::get<TableLayout>(std::move(layout));
    find_clock(cells_of(lines[table_.layout.first_line - 1], table_.layout.separator,
                        table_.layout.columns)
                   .value_or(Cells{}));
    if (Fault fault = find_style()) return *fault;
    if (Fault fault = fill()) return *fault;
    give_columns();
    return std::move(table_);
  }

 private:
  // Which columns hold dates and times.
  void find_clock(const Cells& first_row) {
    for (std::size_t i = 0; i < first_row.size(); ++i) {
      const auto reading = clock_in(first_row[i]);
      if (!reading) continue;
      if (reading->date && date_ == no_column) date_ = i;
      if (reading->of_day_ns && time_ == no_column) time_ = i;
      clocks_.push_back(i);
    }
  }

  bool is_clock(std::size_t column) const {
    return std::ranges::find(clocks_, column) != clocks_.end();
  }

  Fault find_style() {
    const char separator = table_.layout.separator;
    table_.numbers.decimal = hints_.decimal != '\0' ? hints_.decimal : '.';
    if (!may_have_commas(text_, separator) && hints_.decimal == '\0') return std::nullopt;
    NumberMarks marks;
    Fault fault = for_each_row(text_, table_.layout, [&](const Cells& cells, std::size_t line) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!is_clock(i) && may_be_number(cells[i])) marks.add(cells[i], line, i + 1);
      }
      return Fault();
    });
    if (fault) return fault;
    auto style = marks.style(separator, hints_.decimal);
    if (auto* why = std::get_if<std::string>(&style)) return std::move(*why);
    table_.numbers = std::get<NumberStyle>(style);
    return std::nullopt;
  }

  Fault fill() {
    values_.resize(table_.layout.columns);
    if (!clocks_.empty()) table_.clock.emplace();
    return for_each_row(text_, table_.layout, [&](const Cells& cells, std::size_t line) -> Fault {
      if (Fault fault = add_clock(cells, line)) return fault;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (is_clock(i)) continue;
        const auto value = number_in(cells[i], table_.numbers);
        if (!value)
          return fmt::format("{}:{}: \"{}\" is not a number", line, i + 1, cells[i].substr(0, 40));
        values_[i].push_back(*value);
      }
      const bool is_half = cells.size() > 1 && cells[1].size() > 1 && cells[1].front() == '0';
      if (is_half && table_.half_line == 0) table_.half_line = line;
      return std::nullopt;
    });
  }

  Fault add_clock(const Cells& cells, std::size_t line) {
    if (clocks_.empty()) return std::nullopt;
    const std::size_t date = date_ != no_column ? date_ : time_;
    const std::size_t time = time_ != no_column ? time_ : date_;
    const auto dated = clock_in(cells[date]), timed = clock_in(cells[time]);
    const bool fits = dated && timed && (date_ == no_column || dated->date) &&
                      (time_ == no_column || timed->of_day_ns);
    if (!fits) {
      return fmt::format("{}:{}: \"{}\" is no date or time as in the lines before", line,
                         (dated ? time : date) + 1, cells[dated ? time : date].substr(0, 40));
    }
    table_.clock->add(*dated, *timed);
    return std::nullopt;
  }

  void give_columns() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (is_clock(i)) continue;
      const std::vector<double>& values = values_[i];
      const auto& units = table_.layout.units;
      table_.columns.push_back(
          {table_.layout.names[i], units.empty() ? "" : units[i],
           Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values))});
      values_[i] = {};
    }
  }

  static constexpr std::size_t no_column = static_cast<std::size_t>(-1);

  std::string_view text_;
  const TableHints& hints_;
  Table table_;
  std::vector<std::size_t> clocks_;
  std::size_t date_ = no_column, time_ = no_column;
  std::vector<std::vector<double>> values_;
};

}  // namespace

std::variant<Table, std::string> read_table(std::string_view text, const TableHints& hints) {
  return TableReader(text, hints).read();
}

}  // namespace rvbench::hal::formats
