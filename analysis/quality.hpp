#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Channels that a diagnosis looks at: accelerations, or channels whose unit the file does not
/// state. Angle, torque and speed channels are not.
std::vector<const Channel*> acceleration_channels(const Recording& record);

/// What is wrong with the data of one channel: lost samples, dead, clipped, too few samples.
/// @param clip_level  full scale; NaN: clipping is recognised by runs at the extreme value
std::vector<QualityNote> channel_quality(const Channel& channel, double clip_level);

}  // namespace rvbench::analysis
