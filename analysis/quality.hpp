#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Channels that a diagnosis looks at: accelerations, or channels whose unit the file does not
/// state. Angle, torque and speed channels are not.
/// Shape, errors  in their order, none if there is none; nothing thrown. Source  ours
std::vector<const Channel*> acceleration_channels(const Recording& record);

/// What is wrong with the data of one channel: lost samples, dead, clipped, too few samples.
/// @param clip_level  full scale; NaN: clipping is what clipped_samples() finds
/// Shape   at most one note, the gravest; units of the channel
/// Errors  none thrown: what is not finite counts as lost
/// Source  ours: each is what no sensor's own noise leaves
std::vector<QualityNote> channel_quality(const Channel& channel, double clip_level);

/// As channel_quality(), and a stretch of half a second in which the value stands still: on a
/// machine that turns, the sensor was lost meanwhile. A position or a torque may stand still.
/// Shape, units, errors, source  of channel_quality()
std::vector<QualityNote> accelerometer_quality(const Channel& channel, double clip_level);

/// Whether anything in the records says that a machine turns at this speed and rate: a significant
/// signature of what is locked to the shaft, or in half of a point's channels a line of the
/// spectrum on a characteristic order. Every machine that turns shows its shaft; where nothing
/// does, the orders were looked for in the wrong places: their silence means nothing, and what was
/// found there has the wrong name. What slips is no witness, not of itself either: its many lines,
/// stretched by a few percent, meet some line of any recording. Which machine it is, of those that
/// have lines of their own, gear_train_fit() knows.
/// Shape, errors  any number of points; nothing thrown. Source  ours
bool shows_shaft(const std::vector<Examination>& points, const Diagnosis& diagnosis,
                 const Kinematics& kinematics);

}  // namespace rvbench::analysis
