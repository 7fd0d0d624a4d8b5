#include "bench/station/chart_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/station/control_chart.hpp"
#include "bench/station/station_table.hpp"
#include "hal/formats/csv_cells.hpp"
#include "hal/formats/foreign_file.hpp"

namespace rvbench::bench {
namespace {

// The first row whose time lies before that of the row above; numbers by their value, dates from
// year to second as text.
std::optional<std::size_t> find_step_back(const std::vector<std::string>& times) {
  std::vector<double> numbers;
  hal::formats::CsvNumbers reader;
  for (const std::string& time : times) {
    const auto read = reader.read(time);
    if (read.index() == 0) numbers.push_back(std::get<double>(read));
  }
  const bool are_numbers = numbers.size() == times.size();
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (are_numbers ? numbers[i] < numbers[i - 1] : times[i] < times[i - 1]) return i;
  }
  return std::nullopt;
}

}  // namespace

Result<ChartFile> read_chart_file(const std::filesystem::path& file) {
  const auto read = read_station_table(file, {"value"});
  if (!read) return read.error();
  const StationTable& table = read.value();
  const auto time = table.column("time");
  const auto label = time ? time : table.column("run");
  if (!label) return table.fault(1, "no column \"time\" or \"run\": a chart is of values in order");
  const std::size_t value_column = *table.column("value");
  const auto values = table.numbers(value_column);
  if (!values) return values.error();

  ChartFile chart;
  chart.unit = table.heads[value_column].unit;
  for (const StationTable::Row& row : table.rows) chart.labels.push_back(row.cells[*label]);
  const auto back = time ? find_step_back(chart.labels) : std::nullopt;
  if (back) {
    return table.fault(table.rows[*back].line,
                       fmt::format("time {} is before {} in the row above: a chart takes values "
                                   "in the order of time",
                                   chart.labels[*back], chart.labels[*back - 1]));
  }
  const std::vector<double>& numbers = values.value();
  if (Eigen::Index(numbers.size()) < analysis::least_baseline) {
    return hal::formats::bad_file(
        file, fmt::format("{} values: a chart takes {} or more, and {} make a "
                          "good one",
                          numbers.size(), analysis::least_baseline, analysis::good_baseline));
  }
  chart.values = Eigen::Map<const Eigen::VectorXd>(numbers.data(), Eigen::Index(numbers.size()));
  return chart;
}

}  // namespace rvbench::bench
