#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rvbench::hal::formats {

/// The UTF-16 units of a UTF-8 text, as MATLAB keeps text; what is no UTF-8 as '?'.
std::vector<std::uint16_t> utf16_of(std::string_view text);

/// The inverse; half a pair of surrogates as '?'.
std::string utf8_of(std::span<const std::uint16_t> units);

}  // namespace rvbench::hal::formats
