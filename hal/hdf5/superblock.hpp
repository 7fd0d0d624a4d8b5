#pragma once

#include <filesystem>

namespace rvbench::hal::hdf5 {

/// True if the file's head says that somebody opened it for writing and has not closed it: a
/// writer at work, or a dead one.
/// @throws FileFailure if it is no HDF5 file
bool is_marked_open(const std::filesystem::path& path);

}  // namespace rvbench::hal::hdf5
