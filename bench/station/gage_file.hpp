#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/station/gage_study.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// A gage study as it was written down.
struct GageFile {
  analysis::GageReadings readings;
  std::vector<std::string> parts, operators;  ///< their names, in the order of the readings
  std::string unit;                           ///< of the readings; empty if none is stated
};

/// Reads a CSV file of the columns part, operator, trial and value, a reading in each row, in any
/// order. What a trial is called is all one, if each operator has the same for each part.
///
/// Errors  bad_data, with file and line: of read_station_table(), a value that is no number, a
///         reading that is there twice or missing, fewer than 2 of parts, operators or trials
Result<GageFile> read_gage_file(const std::filesystem::path& file);

}  // namespace rvbench::bench
