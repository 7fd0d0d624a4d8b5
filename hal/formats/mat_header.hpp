#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hal/formats/byte_writer.hpp"

namespace rvbench::hal::formats {

/// The 128 bytes that MAT files of v5 and v7.3 begin with: text, no data of a subsystem, version
/// and order of bytes.
inline std::string mat_header(std::string_view text, std::uint16_t version) {
  constexpr std::size_t text_bytes = 116, subsystem_bytes = 8;
  std::string bytes(text.substr(0, text_bytes));
  bytes.resize(text_bytes, ' ');
  bytes.resize(text_bytes + subsystem_bytes, '\0');
  put(bytes, version);
  return bytes + "IM";
}

}  // namespace rvbench::hal::formats
