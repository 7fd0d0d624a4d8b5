#pragma once

#include <filesystem>

namespace rvbench::hal {

/// Puts what was written to a closed file on the disk.
///
/// @return 0, or errno
int sync_file(const std::filesystem::path& file) noexcept;

/// Puts the folder that `file` is in on the disk: a file that is new, renamed or removed stays so
/// through a power failure only then.
///
/// @return 0, or errno. A folder that may not be read, or whose file system does not sync folders,
///         is left as it is
int sync_folder_of(const std::filesystem::path& file) noexcept;

}  // namespace rvbench::hal
