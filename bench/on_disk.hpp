#pragma once

#include <filesystem>

/// What must be on the disk, and is, or why it is not as a std::system_error that names the file.
namespace rvbench::bench {

/// @param error  errno
[[noreturn]] void throw_error(int error, const std::filesystem::path& file);

/// As hal::sync_file() and hal::sync_folder_of(). @throws std::system_error
void put_on_disk(const std::filesystem::path& file);
void put_folder_on_disk(const std::filesystem::path& file);

}  // namespace rvbench::bench
