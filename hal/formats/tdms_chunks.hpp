#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/formats/tdms_file.hpp"

namespace rvbench::hal::formats {

/// What a chunk holds of one channel.
struct TdmsPlace {
  std::size_t channel = 0;  ///< in TdmsFile::channels
  TdmsIndex index;
};

struct TdmsStorage {
  std::endian order = std::endian::little;
  bool is_interleaved = false;  ///< value by value, not channel by channel
  bool is_cut_off = false;      ///< the segment ends before its writer would have ended it
};

/// Appends the values of a segment's raw data, chunk after chunk, to the channels. The last chunk
/// may be shorter: where the segment was cut off, what is there is read as far as it goes; else
/// each channel has its share of it.
/// @return the fault, if there is one
/// Source  National Instruments, "TPC: The NI TDMS File Format"
std::optional<std::string> take_tdms_chunks(std::string_view bytes, const TdmsStorage& storage,
                                            const std::vector<TdmsPlace>& layout, TdmsFile& file);

}  // namespace rvbench::hal::formats
