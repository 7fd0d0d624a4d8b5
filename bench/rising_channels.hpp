#pragma once

#include <optional>
#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// Takes channels that only ever rise, as time or an angle does and no vibration, out of what is to
/// be judged, except `kept`. A note of the recording tells, with the rate that a time would mean.
/// @return why the recording cannot be judged: time that rises unevenly is no single rate. Not
///         asked where `kept` says what is to be judged
std::optional<std::string> leave_out_rising_channels(const std::string& kept, Recording& record);

}  // namespace rvbench::bench
