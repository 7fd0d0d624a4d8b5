#include "bench/station/chart_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <optional>

#include "analysis/station/control_chart.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/station/station_table.hpp"
#include "hal/formats/csv_cells.hpp"
#include "hal/formats/foreign_file.hpp"

namespace rvbench::bench {
namespace {

// A moment; the later one is the larger.
struct Moment {
  std::string utc;  // "20260131T120000Z"; empty where times are numbers
  double rest = 0;  // the number; else what stands behind the seconds

  auto operator<=>(const Moment&) const = default;
};

std::optional<Moment> numbered(const std::string& text) {
  const auto read = hal::formats::CsvNumbers().read(text);
  const double* number = std::get_if<double>(&read);
  if (!number || !std::isfinite(*number)) return std::nullopt;
  return Moment{"", *number};
}

// Behind the seconds may be a fraction of one or, as runs are named, which one it is in that
// second: "20261121T114559Z-2".
std::optional<Moment> dated(const std::string& text) {
  constexpr std::size_t digits_to_seconds = 14, most_digits = 15;  // that a double holds
  const bool is_counted = text.find("Z-") != text.npos;
  const std::size_t end = is_counted ? text.find("Z-") + 1 : text.find_first_of(".,");
  const std::string date = text.substr(0, end);
  const auto utc = utc_of_text(date, false);
  if (!utc) return std::nullopt;
  if (end == text.npos) return Moment{*utc, 0};
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string rest = text.substr(end + 1);
  if (!is_counted && rest.ends_with('Z')) rest.pop_back();
  const bool is_exact = std::ranges::count_if(date, is_digit) == digits_to_seconds;
  if (!is_exact || rest.empty() || rest.size() > most_digits) return std::nullopt;
  if (!std::ranges::all_of(rest, is_digit)) return std::nullopt;
  return Moment{*utc, std::stod(is_counted ? rest : "0." + rest)};
}

// What is wrong with the times: one that is none, or lies before that of the row above. They are
// all numbers, or all dates.
std::optional<IoError> find_fault_of_times(const StationTable& table, std::size_t column) {
  const auto text_of = [column](const StationTable::Row& row) { return row.cells[column]; };
  const bool are_numbers = std::ranges::all_of(
      table.rows, [&](const StationTable::Row& row) { return numbered(text_of(row)).has_value(); });
  std::optional<Moment> before;
  std::string text_before;
  for (const StationTable::Row& row : table.rows) {
    const std::string& text = text_of(row);
    const auto moment = are_numbers ? numbered(text) : dated(text);
    if (!moment) {
      return table.fault(row.line, "time \"" + text +
                                       "\" is none: all are numbers, or dates as 2026-01-31 or "
                                       "2026-01-31T08:00:00; a column \"run\" takes any words");
    }
    if (before && *moment < *before) {
      return table.fault(row.line, fmt::format("time {} is before {} in the row above: a chart "
                                               "takes values in the order of time",
                                               text, text_before));
    }
    before = moment;
    text_before = text;
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
  if (time) {
    if (const auto fault = find_fault_of_times(table, *time)) return *fault;
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
