#pragma once

#include <string>

#include "hal/types/recording.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// Why a recording cannot be compared with this output: no such channel, another unit, samples that
/// are not finite, lost or clipped. Empty if it can.
std::string channel_fault(const Recording& recording, const sim::OutputSpec& output);

}  // namespace rvbench::bench
