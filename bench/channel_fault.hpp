#pragma once

#include <string>

#include "bench/campaign.hpp"
#include "hal/types/recording.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// Why a recording cannot be compared with this output: no such channel, another unit, or samples
/// that are not finite. Empty if it can.
std::string channel_misfit(const Recording& recording, const sim::OutputSpec& output);

/// What makes a channel's samples worth nothing: lost or clipped ones. Empty if nothing does.
std::string quality_fault(const Channel& channel);

/// The one or the other, with the channel's name.
std::string channel_fault(const Recording& recording, const sim::OutputSpec& output);

/// What no sensor gives, where time and value are compared as they are: a number beyond all bounds,
/// or up to three samples a hundred times farther from the median than all but a thousandth.
/// @return "sample 1234 is 1e+06, ..."; empty if there is none
std::string sample_fault(const Channel& channel);

/// Tells of forces that drive the plant and stay at their largest value for a while: they were
/// clipped, unless somebody wanted them so.
void note_clipped_inputs(const sim::PlantSpec& plant, Campaign& campaign);

}  // namespace rvbench::bench
