#pragma once

#include <filesystem>

namespace rvbench::hal {

/// Puts the folder that `file` is in on the disk: a new or renamed file survives a power failure
/// only then. Best effort: a folder that cannot be opened is left as it is.
void sync_folder(const std::filesystem::path& file);

}  // namespace rvbench::hal
