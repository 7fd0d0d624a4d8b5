#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/formats/column_name.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// A CSV file of readings: a head that names its columns, and rows of words and numbers.
struct StationTable {
  struct Row {
    std::size_t line = 0;  ///< in the file, from 1
    std::vector<std::string> cells;
  };
  std::filesystem::path file;
  std::vector<hal::formats::ColumnName> heads;
  std::vector<Row> rows;  ///< each with a cell for every head

  std::optional<std::size_t> column(const std::string& name) const;

  /// The numbers of a column.
  /// Errors  bad_data, with line and column: what is no number, or is lost
  Result<std::vector<double>> numbers(std::size_t column) const;

  /// bad_data: "<file>:<line>: <what>"
  IoError fault(std::size_t line, const std::string& what) const;
};

/// Reads a table whose columns are parted by commas, semicolons or tabs; a unit in the head, as in
/// "value [mm]", is taken out of the name. Blank lines are left out.
///
/// @param needed  names of columns that must be there
/// Errors  bad_data: not there, empty, no rows, a column missing or named twice, a row of another
///         length, each with its place
Result<StationTable> read_station_table(const std::filesystem::path& file,
                                        const std::vector<std::string>& needed);

}  // namespace rvbench::bench
