#pragma once

#include <filesystem>
#include <string>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal::hdf5 {

/// "/points/007"
std::string point_path(int point);

/// Makes a new file with all groups, attributes and empty datasets of a recording, and switches
/// it to SWMR writing, after which only rows can be added.
/// @throws FileFailure, also if the file exists: a recording is never overwritten. A file that it
///         made and could not finish is not left behind
Handle make_skeleton(const std::filesystem::path& path, const RecordingLayout& layout);

}  // namespace rvbench::hal::hdf5
