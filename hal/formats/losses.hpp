#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/formats/writer.hpp"

namespace rvbench::hal::formats {

/// Why a recording cannot be written so, in words; nothing if it can. Each channel must have a
/// rate.
std::optional<std::string> unwritable(const Recording& recording, const Writer& writer);

/// What is known of these recordings and has no place in the format, one sentence each.
std::vector<std::string> losses(const std::vector<Recording>& recordings, const Writer& writer);

}  // namespace rvbench::hal::formats
