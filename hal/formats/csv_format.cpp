#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "hal/formats/apply_units.hpp"
#include "hal/formats/column_name.hpp"
#include "hal/formats/csv_cells.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/time_column.hpp"

namespace rvbench::hal::formats {
namespace {

using Cells = std::vector<std::string_view>;
using Fault = std::optional<std::string>;

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r") == line.npos; }

// Two quotes in a row are one.
std::string head_in(std::string_view cell) {
  std::string head;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    head += cell[i];
    if (cell.substr(i).starts_with("\"\"")) ++i;
  }
  return head;
}

// Samples column by column, as they are gathered line by line.
class Table {
 public:
  // The fault of the next line, or none: then it was added.
  Fault add(std::string_view line);

  std::vector<std::string> names;
  bool has_names = true;  // of its own
  // Two columns of whole numbers without names may be one of numbers with a decimal comma.
  bool may_be_halves() const {
    return !has_names && separator_ == ',' && numbers.decimal == '\0' && columns.size() == 2;
  }
  std::size_t half_line = 0;  // the first where a second cell begins as no whole number does: "05"
  std::vector<std::vector<double>> columns;
  CsvNumbers numbers;

 private:
  Fault begin(const Cells& cells);
  Fault add_numbers(const Cells& cells);

  std::size_t line_ = 0;
  std::size_t blank_line_ = 0;  // the first one behind samples
  char separator_ = ',';
};

Fault Table::add(std::string_view line) {
  ++line_;
  if (line.find('\0') != line.npos)
    return fmt::format("{}: not text; UTF-16 is to be saved as UTF-8", line_);
  if (line_ == 1) {
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    separator_ = csv_separator(line).value_or(',');
  } else if (is_blank(line)) {
    if (blank_line_ == 0 && !columns.front().empty()) blank_line_ = line_;
    return std::nullopt;
  }
  if (blank_line_ > 0) return fmt::format("{}: a blank line, and samples behind it", blank_line_);
  const std::optional<Cells> cells = csv_cells(line, separator_);
  if (!cells) return fmt::format("{}: a quote that does not end", line_);
  return line_ == 1 ? begin(*cells) : add_numbers(*cells);
}

// The channels' names from the first line, or column_1, column_2 ... if it holds numbers.
Fault Table::begin(const Cells& cells) {
  if (cells.empty()) return "1: no channel names";
  has_names = !std::ranges::all_of(
      cells, [](std::string_view cell) { return CsvNumbers().read(cell).index() == 0; });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string name = has_names ? head_in(cells[i]) : fmt::format("column_{}", i + 1);
    if (name.empty()) return fmt::format("1:{}: a channel without name", i + 1);
    if (std::ranges::find(names, name) != names.end()) {
      return fmt::format("1:{}: channel \"{}\" is there twice", i + 1, name);
    }
    names.push_back(name);
  }
  columns.resize(cells.size());
  return has_names ? std::nullopt : add_numbers(cells);
}

Fault Table::add_numbers(const Cells& cells) {
  if (cells.size() != columns.size()) {
    const bool halved = separator_ == ',' && cells.size() == 2 * columns.size();
    return fmt::format("{}: {} values, not {}{}", line_, cells.size(), columns.size(),
                       halved ? ": with decimal commas, columns are to be parted by ;" : "");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto read = numbers.read(cells[i]);
    if (const auto* fault = std::get_if<std::string>(&read)) {
      return fmt::format("{}:{}: {}", line_, i + 1, *fault);
    }
    columns[i].push_back(std::get<double>(read));
    const bool is_half = i == 1 && cells[i].size() > 1 && cells[i][0] == '0';
    if (is_half && half_line == 0) half_line = line_;
  }
  return std::nullopt;
}

Fault fill(std::istream& stream, Table& table) {
  std::string line;
  while (std::getline(stream, line)) {
    if (Fault fault = table.add(line)) return fault;
  }
  return stream.bad() ? Fault("cannot be read to its end") : std::nullopt;
}

// A clock keeps its head as it is: by that it is known.
bool is_clock(const Channel& column) {
  const std::string& head = column.info.name;
  return time_unit_s(head) || (seconds_per_unit(head) && only_rises(column.samples));
}

// Takes the units out of the heads. Names that would be the same without stay as they are.
void state_units(Recording& recording) {
  std::vector<ColumnName> heads;
  for (const Channel& column : recording.channels) {
    const std::string& head = column.info.name;
    heads.push_back(is_clock(column) ? ColumnName{head, ""} : column_name(head));
  }
  for (std::size_t i = 0; i < heads.size(); ++i) {
    Channel& channel = recording.channels[i];
    if (std::ranges::count(heads, heads[i].name, &ColumnName::name) == 1) {
      channel.info.name = heads[i].name;
    }
    apply_unit(heads[i].unit, channel, recording.notes);
  }
}

bool is_csv(std::string_view head) {
  const auto is_text = [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\r' || c == '\t';
  };
  return std::ranges::all_of(head, is_text) &&
         csv_separator(head.substr(0, head.find('\n'))).has_value();
}

Result<std::vector<Recording>> read_csv(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Table table;
  if (const Fault fault = fill(stream, table)) return bad_file(file, *fault);
  if (table.may_be_halves() && table.half_line > 0) {
    return bad_file(file,
                    fmt::format("{}:2: begins with 0: if numbers have a decimal comma, put \"\" "
                                "around them; if not, give the columns names",
                                table.half_line));
  }
  Recording recording;
  recording.source = file.string();
  recording.status = "ok";
  if (table.may_be_halves()) {
    recording.notes.emplace_back(
        "taken as two columns of whole numbers, not as one with a decimal comma");
  }
  if (table.numbers.decimal == ',') recording.notes.push_back("numbers have a decimal comma");
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const std::vector<double>& column = table.columns[i];
    Channel channel;
    channel.info.name = table.names[i];
    channel.samples =
        Eigen::Map<const Eigen::VectorXd>(column.data(), static_cast<Eigen::Index>(column.size()));
    recording.channels.push_back(std::move(channel));
  }
  set_rate_by_time_column(table.has_names, recording);
  if (table.has_names) state_units(recording);
  return alone(std::move(recording));
}

}  // namespace

Format csv_format() { return {"CSV", is_csv, {".csv", ".txt"}, read_csv}; }

}  // namespace rvbench::hal::formats
