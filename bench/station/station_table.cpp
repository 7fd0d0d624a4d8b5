#include "bench/station/station_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>
#include <variant>

#include "hal/did_you_mean.hpp"
#include "hal/formats/csv_cells.hpp"
#include "hal/formats/foreign_file.hpp"

namespace rvbench::bench {
namespace {

namespace formats = hal::formats;

std::vector<std::string> names_of(const StationTable& table) {
  std::vector<std::string> names;
  for (const formats::ColumnName& head : table.heads) names.push_back(head.name);
  return names;
}

std::optional<IoError> find_fault_of_head(const StationTable& table,
                                          const std::vector<std::string>& needed) {
  const std::vector<std::string> names = names_of(table);
  for (const std::string& name : needed) {
    const auto count = std::ranges::count(names, name);
    if (count == 1) continue;
    return table.fault(
        1, count > 1 ? "column \"" + name + "\" is there twice"
                     : "no column \"" + name + "\": the first line names the columns " +
                           hal::listed(needed) + "; it has " + hal::in_quotes(hal::listed(names)));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> StationTable::column(const std::string& name) const {
  const auto at = std::ranges::find(heads, name, &formats::ColumnName::name);
  if (at == heads.end()) return std::nullopt;
  return std::size_t(at - heads.begin());
}

Result<std::vector<double>> StationTable::numbers(std::size_t column) const {
  formats::CsvNumbers reader;
  std::vector<double> numbers;
  for (const Row& row : rows) {
    const auto read = reader.read(row.cells[column]);
    if (const auto* why = std::get_if<std::string>(&read)) {
      return fault(row.line, heads[column].name + ": " + *why);
    }
    numbers.push_back(std::get<double>(read));
    if (!std::isfinite(numbers.back())) return fault(row.line, heads[column].name + " is lost");
  }
  return numbers;
}

IoError StationTable::fault(std::size_t line, const std::string& what) const {
  return {IoErrc::bad_data, fmt::format("{}:{}: {}", file.string(), line, what)};
}

Result<StationTable> read_station_table(const std::filesystem::path& file,
                                        const std::vector<std::string>& needed) {
  if (auto obstacle = formats::find_obstacle(file)) return *obstacle;
  StationTable table;
  table.file = file;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  char separator = ',';
  for (std::size_t line = 1; std::getline(stream, text); ++line) {
    std::string_view view = text;
    if (line == 1) {
      if (view.starts_with("\xEF\xBB\xBF")) view.remove_prefix(3);
      separator = formats::csv_separator(view).value_or(',');
    }
    if (view.find('\0') != view.npos) return table.fault(line, "not text");
    const auto cells = formats::csv_cells(view, separator);
    if (!cells) return table.fault(line, "a quote that does not end");
    if (line == 1) {
      for (const std::string_view cell : *cells) table.heads.push_back(formats::column_name(cell));
      if (auto fault = find_fault_of_head(table, needed)) return *fault;
      continue;
    }
    if (cells->empty()) continue;
    if (cells->size() != table.heads.size()) {
      return table.fault(line, fmt::format("{} values, not {}", cells->size(), table.heads.size()));
    }
    table.rows.push_back({line, {cells->begin(), cells->end()}});
  }
  if (stream.bad()) return formats::bad_file(file, "cannot be read to its end");
  if (table.rows.empty()) return formats::bad_file(file, "no rows");
  return table;
}

}  // namespace rvbench::bench
