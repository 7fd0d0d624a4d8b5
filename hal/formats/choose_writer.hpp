#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/formats/writer.hpp"

namespace rvbench::hal::formats {

/// All that can be written, in the order of --help.
std::vector<Writer> known_writers();

/// The writer of that key or, without one, of the file's extension; nothing if none is known.
std::optional<Writer> choose_writer(const std::filesystem::path& file, std::string_view key = "");

}  // namespace rvbench::hal::formats
