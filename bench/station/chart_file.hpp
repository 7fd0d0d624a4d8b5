#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/types/result.hpp"

namespace rvbench::bench {

/// Values in the order of time.
struct ChartFile {
  Eigen::VectorXd values;
  std::vector<std::string> labels;  ///< of the runs or times, one a value
  std::string unit;                 ///< of the values; empty if none is stated
};

/// Reads a CSV file of the columns value and run or time, in the order of time. Times are all
/// numbers, or all dates, as 2026-01-31, 2026-01-31 08:00 or 20260131T120000Z, and do not go back.
///
/// Errors  bad_data, with file and line: of read_station_table(), a value that is no number, a time
///         that is none or goes back, fewer values than a chart takes
Result<ChartFile> read_chart_file(const std::filesystem::path& file);

}  // namespace rvbench::bench
