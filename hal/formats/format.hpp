#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal/formats/table/table_hints.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// One file format. A new one is a new file with a function that returns this, named in the list
/// of choose_format.cpp.
struct Format {
  std::string_view name;
  /// By the file's first bytes (up to 4096).
  bool (*recognises)(std::string_view head);
  std::vector<std::string_view> extensions;  ///< of files that nobody recognises; lower case
  /// `file` is a regular file, readable and not empty. Leaves rate_Hz 0 where it is not stated.
  Result<std::vector<Recording>> (*read)(const std::filesystem::path& file,
                                         const TableHints& hints);
};

Format hdf5_format();
Format mat5_format();
Format mat73_format();
Format tdms_format();
Format wav_format();
Format flac_format();
Format uff_format();
Format csv_format();

}  // namespace rvbench::hal::formats
