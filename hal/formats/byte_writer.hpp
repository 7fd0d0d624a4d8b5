#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace rvbench::hal::formats {

/// Appends the bytes of a number, least significant first.
template <typename Number>
void put(std::string& bytes, Number number) {
  char copy[sizeof(Number)];
  std::memcpy(copy, &number, sizeof(Number));
  if (std::endian::native != std::endian::little) std::reverse(copy, copy + sizeof(Number));
  bytes.append(copy, sizeof(Number));
}

}  // namespace rvbench::hal::formats
