#pragma once

#include <string>
#include <string_view>

namespace rvbench::hal::formats {

/// The text with each control character and each byte that is not UTF-8 as '?': names out of a
/// foreign file must not break a report, a terminal or a JSON document.
std::string printable(std::string_view text);

}  // namespace rvbench::hal::formats
