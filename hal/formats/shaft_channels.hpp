#pragma once

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// Makes use of what a file measured of the shaft: the angles of input and output have the turns
/// that an encoder leaves out, and a channel of speed, in rad/s, gives the recording's speed where
/// the file states none and the shaft is steady, by its middle value. What was taken is noted.
/// Errors  none thrown. Source  definition
void use_shaft_channels(Recording& recording);

/// Calls the one angle that turns on, in rad, that of the input shaft, where no channel is called
/// so; with a note. @return whether there was one
/// Errors  none thrown. Source  definition
bool name_input_angle(Recording& recording);

}  // namespace rvbench::hal::formats
