#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// What is wrong with each acceleration channel of one record of a machine that turns. First
/// accelerometer_quality(); of the channels that pass it, those that spikes, drift, a broken IEPE
/// supply or mains hum spoil, the first of these that is found: each such note invalidates. Of what
/// is sound so far, samples that stood still are noted.
///
/// Spikes are told only where they are fewer than one in four turns: a sound sensor that is sampled
/// far below its resonance, without a filter, shows each strike of a bad bearing as one.
///
/// Shape   one list per channel, in their order, of one note at most
/// Cost    one spectrum per channel
/// Units   those of the channels. Errors  none thrown for what was measured. Source  ours
std::vector<std::vector<QualityNote>> record_quality(const std::vector<const Channel*>& channels,
                                                     const ShaftAngle& angle,
                                                     const Kinematics& kinematics,
                                                     double clip_level);

}  // namespace rvbench::analysis
