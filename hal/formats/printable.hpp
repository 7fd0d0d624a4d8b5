#pragma once

#include <string>
#include <string_view>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// The text with each control character and each byte that is not UTF-8 as '?': names out of a
/// foreign file must not break a report, a terminal or a JSON document.
std::string printable(std::string_view text);

/// The same of all names, units, directions, notes and the status of a recording.
/// @return whether any was another before
bool make_printable(Recording& recording);

/// A line's end, a tab, DEL, ...
bool has_control_character(std::string_view text);

/// What is told where it was.
inline constexpr const char* was_not_printable =
    "characters of names or other text that cannot be shown stand as ?";

}  // namespace rvbench::hal::formats
