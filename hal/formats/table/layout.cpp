#include "hal/formats/table/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <tuple>

#include "hal/formats/csv_cells.hpp"
#include "hal/formats/si_unit.hpp"
#include "hal/formats/table/clock_cells.hpp"
#include "hal/formats/table/number_marks.hpp"
#include "hal/formats/table/text.hpp"

namespace rvbench::hal::formats {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::array<char, 4> separators = {'\t', ';', ',', ' '};

// "#", "%" and "//" begin a comment. "!" and ";" do so in exports of old programs.
std::string_view without_comment_mark(std::string_view line) {
  line = said_in(line);
  const std::size_t marks = line.find_first_not_of("#%!");
  if (marks == line.npos) return {};
  if (marks > 0) return said_in(line.substr(marks));
  return line.starts_with("//") ? said_in(line.substr(2)) : line;
}

bool is_comment(std::string_view line) {
  line = said_in(line);
  return !line.empty() && without_comment_mark(line).size() < line.size();
}

// Excel's first line: "sep=;".
char stated_separator(std::string_view line) {
  line = said_in(line);
  const bool says = line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP="));
  return says ? line[4] : '\0';
}

bool is_sample_row(const Cells& cells) {
  bool has_value = false;
  for (const std::string_view cell : cells) {
    const bool is_value = may_be_number(cell) || clock_in(cell);
    if (!is_value && !is_lost(cell)) return false;
    has_value = has_value || is_value;
  }
  return has_value;
}

// A run of sample rows with as many cells each.
struct Run {
  std::size_t columns = 0, rows = 0;
};

// A mark that parts cells beats one that does not: "1,5" is rather two cells than one.
bool is_better(const Run& run, const Run& best) {
  const auto rank = [](const Run& r) { return std::tuple(r.columns > 1, r.rows, r.columns); };
  return rank(run) > rank(best);
}

Run longest_run(const std::vector<std::string_view>& lines, char separator) {
  Run longest, now;
  for (const std::string_view line : lines) {
    if (is_blank(line)) continue;
    const auto cells = is_comment(line) ? std::nullopt : cells_of(line, separator, now.columns);
    if (!cells || !is_sample_row(*cells)) {
      now = {};
      continue;
    }
    if (cells->size() != now.columns) now = {cells->size(), 0};
    ++now.rows;
    if (now.rows > longest.rows) longest = now;
  }
  return longest;
}

bool is_unit_cell(std::string_view cell) {
  if (cell.empty() || cell == "-" || cell == "%" || cell == "1") return true;
  const bool in_brackets =
      (cell.front() == '[' && cell.back() == ']') || (cell.front() == '(' && cell.back() == ')');
  return in_brackets || si_unit(cell);
}

std::string without_brackets(std::string_view cell) {
  if (cell.size() >= 2 && (cell.front() == '[' || cell.front() == '(')) {
    cell = said_in(cell.substr(1, cell.size() - 2));
  }
  return std::string(cell);
}

// Two quotes in a row are one.
std::string unquoted(std::string_view cell) {
  std::string text;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    text += cell[i];
    if (cell.substr(i).starts_with("\"\"")) ++i;
  }
  return text;
}

class LayoutFinder {
 public:
  LayoutFinder(const std::vector<std::string_view>& lines, const TableHints& hints)
      : lines_(lines), hints_(hints) {}

  std::variant<TableLayout, std::string> find() {
    if (!choose_separator()) return no_table();
    if (auto fault = find_first_row()) return *fault;
    if (auto fault = find_head()) return *fault;
    for (std::size_t i = 0;
         i + 1 < (layout_.head_line > 0 ? layout_.head_line : layout_.first_line); ++i) {
      if (!is_blank(lines_[i]) && stated_separator(lines_[i]) == '\0') {
        layout_.above.emplace_back(without_comment_mark(lines_[i]));
      }
    }
    return std::move(layout_);
  }

 private:
  bool choose_separator() {
    const char stated = hints_.separator != '\0' ? hints_.separator
                        : lines_.empty()         ? '\0'
                                                 : stated_separator(lines_.front());
    Run best;
    for (const char separator : separators) {
      if (stated != '\0' && separator != stated) continue;
      const Run run = longest_run(lines_, separator);
      if (!is_better(run, best)) continue;
      best = run;
      layout_.separator = separator;
    }
    layout_.columns = best.columns;
    return best.rows > 0;
  }

  std::optional<std::string> find_first_row() {
    for (std::size_t i = hints_.head_line; i < lines_.size(); ++i) {
      const auto cells = row(i);
      if (!cells || cells->size() != layout_.columns || !is_sample_row(*cells)) continue;
      layout_.first_line = i + 1;
      return std::nullopt;
    }
    return fmt::format("no samples below line {}", hints_.head_line);
  }

  // The nearest line above the samples that is not blank; 0 if there is none.
  std::size_t line_above(std::size_t line) const {
    while (line > 1 && is_blank(lines_[line - 2])) --line;
    return line - 1;
  }

  std::optional<Cells> row(std::size_t index) const {
    const std::string_view line = lines_[index];
    if (is_blank(line) || is_comment(line)) return std::nullopt;
    return cells_of(line, layout_.separator, layout_.columns);
  }

  // The cells of a line that may be a head, also in a comment.
  Cells head_cells(std::size_t line) const {
    if (line == 0 || stated_separator(lines_[line - 1]) != '\0') return {};
    const std::string_view text = without_comment_mark(lines_[line - 1]);
    return cells_of(text, layout_.separator, layout_.columns).value_or(Cells{});
  }

  std::optional<std::string> find_head() {
    const std::size_t nearest =
        hints_.head_line > 0 ? hints_.head_line : line_above(layout_.first_line);
    if (nearest > 0 && !csv_cells(lines_[nearest - 1], layout_.separator))
      return open_quote(nearest);
    Cells names = head_cells(nearest);
    if (auto fault = broken_row(names, nearest)) return fault;
    layout_.head_line = nearest;
    if (hints_.head_line > 0) {
      take_units_below(nearest);
    } else if (names.size() == layout_.columns && std::ranges::all_of(names, is_unit_cell)) {
      const std::size_t next = line_above(nearest);
      const Cells above = head_cells(next);
      if (above.size() == layout_.columns && !std::ranges::all_of(above, is_unit_cell)) {
        for (const std::string_view unit : names) layout_.units.push_back(without_brackets(unit));
        names = above;
        layout_.head_line = next;
      }
    }
    return take_names(names, nearest);
  }

  // A line of text and numbers below another one with as many cells is rather a broken row than a
  // head.
  std::optional<std::string> broken_row(const Cells& cells, std::size_t line) const {
    const bool has_number = std::ranges::any_of(cells, may_be_number);
    if (hints_.head_line > 0 || line < 2 || !has_number || cells.size() != layout_.columns) {
      return std::nullopt;
    }
    if (head_cells(line - 1).size() != layout_.columns) return std::nullopt;
    const auto bad = std::ranges::find_if_not(
        cells, [](std::string_view cell) { return may_be_number(cell) || is_lost(cell); });
    return fmt::format(
        "{}:{}: \"{}\" is not a number; if the line names columns, state --head-line {}", line,
        bad - cells.begin() + 1, bad->substr(0, 40), line);
  }

  void take_units_below(std::size_t head) {
    for (std::size_t line = head + 1; line < layout_.first_line; ++line) {
      const Cells cells = head_cells(line);
      if (cells.size() != layout_.columns || !std::ranges::all_of(cells, is_unit_cell)) continue;
      for (const std::string_view unit : cells) layout_.units.push_back(without_brackets(unit));
      return;
    }
  }

  std::optional<std::string> take_names(Cells names, std::size_t nearest) {
    if (names.size() == layout_.columns + 1 && ends_blank(layout_.first_line)) ++layout_.columns;
    const std::size_t columns = layout_.columns;
    // R leaves out the name of the rows' own names.
    if (names.size() + 1 == columns && names.size() > 1 && hints_.head_line == 0 &&
        starts_with_index()) {
      names.insert(names.begin(), std::string_view());
    }
    // LabVIEW names a column of comments that its rows leave out.
    if (names.size() == columns + 1 && names.back() == "Comment") names.pop_back();
    const bool is_head = names.size() == columns;
    if (is_head) {
      for (const std::string_view name : names) layout_.names.push_back(unquoted(name));
      return std::nullopt;
    }
    const bool is_beside =
        nearest > 0 && (nearest + 1 == layout_.first_line || hints_.head_line > 0);
    layout_.head_line = 0;
    layout_.names.resize(columns);
    if (!is_beside || (names.size() < 2 && columns != 2 * names.size() && hints_.head_line == 0) ||
        (nearest > 1 && hints_.head_line == 0)) {
      return std::nullopt;
    }
    const bool halved = layout_.separator == ',' && columns == 2 * names.size();
    return fmt::format("{}: {} values, not {} as line {} has names{}", layout_.first_line, columns,
                       names.size(), nearest,
                       halved ? ": with decimal commas, columns are to be parted by ;" : "");
  }

  // Whether a row has a blank cell behind its last separator.
  bool ends_blank(std::size_t line) const {
    return cells_of(lines_[line - 1], layout_.separator, layout_.columns + 1)
               .value_or(Cells{})
               .size() > layout_.columns;
  }

  // Whether the first cells of the first two rows count.
  bool starts_with_index() const {
    if (layout_.first_line >= lines_.size()) return false;
    const auto first = row(layout_.first_line - 1), second = row(layout_.first_line);
    if (!first || !second || first->empty() || second->empty()) return false;
    const auto begins = [](const Cells& cells, std::string_view text) { return cells[0] == text; };
    return (begins(*first, "0") && begins(*second, "1")) ||
           (begins(*first, "1") && begins(*second, "2"));
  }

  static std::string open_quote(std::size_t line) {
    return fmt::format("{}: a quote that does not end", line);
  }

  std::string no_table() const {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (!csv_cells(lines_[i], ',')) return open_quote(i + 1);
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (is_blank(lines_[i])) continue;
      return fmt::format("holds no samples: no line of numbers from line {} on: \"{}\"", i + 1,
                         lines_[i].substr(0, 40));
    }
    return "holds no samples";
  }

  const std::vector<std::string_view>& lines_;
  const TableHints& hints_;
  TableLayout layout_;
};

}  // namespace

std::optional<Cells> cells_of(std::string_view line, char separator, std::size_t columns) {
  auto cells = csv_cells(line, separator);
  if (!cells) return cells;
  const std::size_t end = line.find_last_not_of(separator == '\t' ? " \r" : " \t\r");
  const bool ends_blank = separator != ' ' && end != line.npos && line[end] == separator;
  if (ends_blank && cells->size() + 1 == columns) cells->emplace_back();
  return cells;
}

std::variant<TableLayout, std::string> layout_of(const std::vector<std::string_view>& lines,
                                                 const TableHints& hints) {
  return LayoutFinder(lines, hints).find();
}

}  // namespace rvbench::hal::formats
