#pragma once

#include <string>
#include <vector>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// Gives channels that have no name, or that of one before them, one of their own: "channel_3",
/// "accel_2". Many a program takes two channels of one name for one.
/// @return what was done, one sentence each
std::vector<std::string> make_names_distinct(Recording& recording);

}  // namespace rvbench::hal::formats
