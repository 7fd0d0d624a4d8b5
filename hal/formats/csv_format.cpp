#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/time_column.hpp"

namespace rvbench::hal::formats {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

// The cells of one line. A separator at its end adds no cell.
std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  line = trimmed(line);
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(separator), line.size());
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
      cell = cell.substr(1, cell.size() - 2);
    }
    cells.push_back(cell);
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return cells;
}

// A number; "nan" is one, for it marks a lost sample, but an infinity is none.
std::optional<double> parse_number(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || std::isinf(value)) {
    return std::nullopt;
  }
  return value;
}

char separator_of(std::string_view line) {
  for (const char separator : {',', ';', '\t'}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

// Samples column by column, as they are gathered line by line.
struct Table {
  std::vector<std::string> names;
  bool has_names = true;  // of its own
  std::vector<std::vector<double>> columns;

  // The fault of one line of numbers, or none: then the line was added.
  std::optional<std::string> add(const std::vector<std::string_view>& cells, std::size_t line) {
    if (cells.size() != columns.size()) {
      return fmt::format("{}: {} values, not {}", line, cells.size(), columns.size());
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::optional<double> value = parse_number(cells[i]);
      if (!value) {
        return fmt::format("{}:{}: \"{}\" is not a number", line, i + 1, cells[i].substr(0, 40));
      }
      columns[i].push_back(*value);
    }
    return std::nullopt;
  }
};

// The channels' names from the first line, or column_1, column_2 ... if it holds numbers.
std::optional<std::string> start(const std::vector<std::string_view>& cells, Table& table) {
  if (cells.empty()) return "1: no channel names";
  const auto is_number = [](std::string_view cell) { return parse_number(cell).has_value(); };
  const bool headless = std::all_of(cells.begin(), cells.end(), is_number);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string name = headless ? fmt::format("column_{}", i + 1) : std::string(cells[i]);
    if (name.empty()) return fmt::format("1:{}: a channel without name", i + 1);
    if (std::find(table.names.begin(), table.names.end(), name) != table.names.end()) {
      return fmt::format("1:{}: channel \"{}\" is there twice", i + 1, name);
    }
    table.names.push_back(name);
  }
  table.columns.resize(cells.size());
  table.has_names = !headless;
  return headless ? table.add(cells, 1) : std::nullopt;
}

struct UnitName {
  std::string_view written;
  std::string_view unit;
};

// Of what a vibration may be in, or be mistaken for. A voltage may be anything's, so it says
// nothing; a unit of time belongs to no signal.
constexpr std::array<UnitName, 16> unit_names = {{{"m/s²", "m/s²"},
                                                  {"m/s2", "m/s²"},
                                                  {"m/s^2", "m/s²"},
                                                  {"g", "g"},
                                                  {"m/s", "m/s"},
                                                  {"mm/s", "mm/s"},
                                                  {"in/s", "in/s"},
                                                  {"ips", "in/s"},
                                                  {"mm", "mm"},
                                                  {"µm", "µm"},
                                                  {"um", "µm"},
                                                  {"N", "N"},
                                                  {"N·m", "N·m"},
                                                  {"Nm", "N·m"},
                                                  {"rpm", "rpm"},
                                                  {"°C", "°C"}}};

// The unit that a column's name ends in, as "a [g]" and "a (mm/s)", or, where it cannot be a word
// of the name, "a_mm/s"; empty if it ends in none.
std::string_view unit_in(std::string_view name) {
  const bool bracketed = name.ends_with(']') || name.ends_with(')');
  if (bracketed) name.remove_suffix(1);
  const std::size_t before = name.find_last_of(bracketed ? "[(" : "_ ");
  if (before == std::string_view::npos) return "";
  const std::string_view written = trimmed(name.substr(before + 1));
  if (!bracketed && written.find('/') == std::string_view::npos) return "";
  const auto found = std::ranges::find(unit_names, written, &UnitName::written);
  return found == unit_names.end() ? "" : found->unit;
}

std::optional<std::string> fill(std::istream& stream, Table& table) {
  std::string text;
  char separator = ',';
  for (std::size_t line = 1; std::getline(stream, text); ++line) {
    if (text.find('\0') != std::string::npos) return fmt::format("{}: not text", line);
    std::string_view view = text;
    if (line == 1) {
      if (view.starts_with("\xEF\xBB\xBF")) view.remove_prefix(3);
      separator = separator_of(view);
      if (auto fault = start(split(view, separator), table)) return fault;
    } else if (!trimmed(view).empty()) {
      if (auto fault = table.add(split(view, separator), line)) return fault;
    }
  }
  return stream.bad() ? std::optional<std::string>("cannot be read to its end") : std::nullopt;
}

bool recognises(std::string_view head) {
  const auto is_text = [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\r' || c == '\t';
  };
  const std::string_view first = head.substr(0, head.find('\n'));
  return std::all_of(head.begin(), head.end(), is_text) &&
         first.find_first_of(",;\t") != std::string_view::npos;
}

Result<std::vector<Recording>> read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Table table;
  if (const auto fault = fill(stream, table)) return bad_file(file, *fault);
  Recording recording;
  recording.source = file.string();
  recording.status = "ok";
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const std::vector<double>& column = table.columns[i];
    Channel channel;
    channel.info.name = table.names[i];
    channel.info.unit = unit_in(table.names[i]);
    channel.samples =
        Eigen::Map<const Eigen::VectorXd>(column.data(), static_cast<Eigen::Index>(column.size()));
    recording.channels.push_back(std::move(channel));
  }
  set_rate_by_time_column(table.has_names, recording);
  return std::vector<Recording>{std::move(recording)};
}

}  // namespace

Format csv_format() { return {"CSV", recognises, {".csv", ".txt"}, read}; }

}  // namespace rvbench::hal::formats
