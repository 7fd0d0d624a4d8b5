#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/formats/tdms_metadata.hpp"

namespace rvbench::hal::formats {

/// `TdmsChannel::raw` of values that are no DAQmx raw data; scalings call their input so, too.
inline constexpr std::uint32_t tdms_raw_values = 0xFFFFFFFF;

/// One channel, its values as they are stored, put together from all segments.
struct TdmsChannel {
  std::string group;
  std::string name;
  TdmsProperties properties;
  std::map<std::uint32_t, std::vector<double>> raw;  ///< by scale id
  bool is_time = false;                              ///< timestamps, in s since the first one
  std::optional<std::int64_t> start_s;               ///< whole seconds of that, since 1904
  std::uint64_t declared = 0;                        ///< values, by the segments' indices
  std::string gap;  ///< where a segment's values are not the next ones; empty if they all are
};

struct TdmsFile {
  std::map<std::string, TdmsProperties> groups;
  std::vector<TdmsChannel> channels;  ///< with values or without, in order of appearance
  bool is_cut_off = false;            ///< less is there than the segments declare
  bool is_unfinished = false;         ///< its writer was cut off in the last segment
};

/// Puts the segments of a file together. Returns the fault instead, with the segment it is in.
std::variant<TdmsFile, std::string> read_tdms(std::string_view bytes);

}  // namespace rvbench::hal::formats
