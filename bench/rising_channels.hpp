#pragma once

#include <optional>
#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// Takes channels that only ever rise, as time or an angle does and no vibration, out of what is to
/// be judged, except `kept`. A note of the recording tells, with the rate that a time would mean
/// and, where another is taken, that one.
/// @return why the recording cannot be judged: time that rises unevenly, for rows are missing or
///         its rate changes, or what is named as time and does not rise. Where `kept` says what is
///         to be judged a note tells of the former
std::optional<std::string> leave_out_rising_channels(const std::string& kept, Recording& record);

/// Why samples must not be written on as those of one even clock: a channel that is time, by its
/// name, as the first of a table without names or for it rises in seconds, rises unevenly or does
/// not rise. Of another that rises unevenly a note of the recording tells, but of none of a shaft.
/// @return nothing if they may
std::optional<std::string> what_breaks_the_clock(Recording& record);

}  // namespace rvbench::bench
