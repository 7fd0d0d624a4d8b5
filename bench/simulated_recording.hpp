#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// Takes the first `samples` off, and starts as much later.
void drop_lead_in(Channel& channel, Eigen::Index samples);

/// Time and every channel in columns; channels of one rate, length and start.
std::string csv_of(const Recording& recording);

/// A recording of rvbench's own format: a point of each, with input_torque and input_angle.
/// @return why not: one of them has no such channels, the file exists or cannot be written
Status write_hdf5(const std::filesystem::path& file, const std::vector<Recording>& recordings);

/// A recording of rvbench's own format, of vibration alone: a point of each, all channels on one
/// clock. Units stay those of the channels.
/// @return why not: the file exists or cannot be written
/// @throws std::invalid_argument: no recording, channels that differ in rate or length, or from
///         those of the first recording in number
Status write_vibration_hdf5(const std::filesystem::path& file,
                            const std::vector<Recording>& recordings);

}  // namespace rvbench::bench
