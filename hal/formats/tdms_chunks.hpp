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
};

/// Appends the values of a segment's raw data, chunk after chunk, to the channels; the last chunk
/// may be cut off. Returns the fault, if there is one.
std::optional<std::string> take_tdms_chunks(std::string_view bytes, const TdmsStorage& storage,
                                            const std::vector<TdmsPlace>& layout, TdmsFile& file);

}  // namespace rvbench::hal::formats
