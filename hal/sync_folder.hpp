#pragma once

#include <filesystem>

namespace rvbench::hal {

/// Puts the folder that `file` is in on the disk: a file that is new, renamed or removed stays so
/// through a power failure only then.
///
/// @return 0, or errno. A folder that may not be read, or whose file system does not sync folders,
///         is left as it is
int sync_folder(const std::filesystem::path& file) noexcept;

}  // namespace rvbench::hal
