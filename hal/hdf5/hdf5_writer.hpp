#pragma once

#include <chrono>
#include <filesystem>
#include <memory>

#include "hal/recording_file.hpp"

namespace rvbench::hal::hdf5 {

/// Writes the HDF5 file of a recording, for readers that follow it, and nothing beside it. What it
/// says is RecordingWriter's, but for loss: what it wrote survives a crash only by its journal.
/// @throws FileFailure if the file cannot be made, or exists
std::unique_ptr<RecordingWriter> make_hdf5_writer(const std::filesystem::path& file,
                                                  const RecordingLayout& layout,
                                                  std::chrono::milliseconds flush_interval);

/// Puts a closed file, or the folder that it is in, on the disk. Both throw FileFailure.
void put_on_disk(const std::filesystem::path& file);
void put_folder_on_disk(const std::filesystem::path& file);

}  // namespace rvbench::hal::hdf5
