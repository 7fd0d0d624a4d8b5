#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// Why `file` cannot be read: it is not there, a folder, not to be opened, empty.
std::optional<IoError> find_obstacle(const std::filesystem::path& file);

/// The first bytes of a file, up to 4096.
std::string head_of(const std::filesystem::path& file);

/// All bytes of a file.
std::string bytes_of(const std::filesystem::path& file);

/// What a file of one recording holds, moved: braces would copy its samples.
std::vector<Recording> alone(Recording&& recording);

/// "<file>: <what>", as bad_data
IoError bad_file(const std::filesystem::path& file, const std::string& what);

}  // namespace rvbench::hal::formats
