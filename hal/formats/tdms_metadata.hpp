#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/formats/byte_reader.hpp"

namespace rvbench::hal::formats {

/// Types of values, as files number them.
enum class TdmsType : std::uint32_t {
  nothing = 0,
  int8 = 1,
  int16 = 2,
  int32 = 3,
  int64 = 4,
  uint8 = 5,
  uint16 = 6,
  uint32 = 7,
  uint64 = 8,
  float32 = 9,
  float64 = 10,
  float32_with_unit = 0x19,
  float64_with_unit = 0x1A,
  text = 0x20,
  boolean = 0x21,
  timestamp = 0x44,
  daqmx_raw = 0xFFFFFFFF
};

/// From 1904-01-01 UTC, where the format's times begin, to 1970-01-01.
inline constexpr double tdms_epoch_before_1970_s = 2082844800;

/// Bytes of one value; 0 for text, and for what is not known here.
std::size_t bytes_of_type(TdmsType type);

/// Where a DAQ device's raw values of one channel are in its buffer.
struct TdmsScaler {
  TdmsType type = TdmsType::nothing;
  std::uint32_t buffer = 0;
  std::uint32_t byte_offset = 0;  ///< in a row of the buffer
  std::optional<unsigned> bit;    ///< of a digital line
  std::uint32_t scale_id = 0;     ///< by which scalings ask for these values
};

/// How the values of one channel are stored in a segment.
struct TdmsIndex {
  TdmsType type = TdmsType::nothing;
  std::uint64_t count = 0;       ///< values per chunk
  std::uint64_t text_bytes = 0;  ///< per chunk, of texts
  std::vector<TdmsScaler> scalers;
  std::vector<std::uint32_t> row_bytes;  ///< of each DAQmx buffer
};

using TdmsProperties = std::map<std::string, std::variant<double, std::string>>;

/// One object as a segment mentions it.
struct TdmsObject {
  std::string path;  ///< "/'group'/'channel'"
  bool has_data = false;
  bool is_as_before = false;  ///< the index is that of the last segment that had one
  TdmsIndex index;
  TdmsProperties properties;  ///< numbers, times (s since 1904), truth values (0, 1) and texts
};

/// Parses the metadata of a segment. Returns the fault instead, in words.
///
/// Source  National Instruments, "TPC: The NI TDMS File Format"; the layout of DAQmx indices is not
///         published by its maker and is as readers of others take it
std::variant<std::vector<TdmsObject>, std::string> read_tdms_metadata(ByteReader& reader,
                                                                      std::endian order);

}  // namespace rvbench::hal::formats
