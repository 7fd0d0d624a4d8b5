#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hal/formats/format.hpp"

namespace rvbench::hal::formats {

/// The format of a recording, by its content, then by its extension; nothing if none is known.
/// `file` is a regular file, readable and not empty.
std::optional<Format> choose_format(const std::filesystem::path& file);

/// ".h5" of "A.H5"
std::string lower_extension(const std::filesystem::path& file);

}  // namespace rvbench::hal::formats
