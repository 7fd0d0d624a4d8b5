#pragma once

#include <functional>
#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::test {

/// The first flaw of a record's accelerations that invalidates it; empty if there is none.
using RecordCheck = std::function<std::string(const Recording&)>;

/// What the judge of a run finds.
std::string flaw_of_record(const Recording& record);

/// What a judge finds who looks at each channel by itself,
std::string flaw_of_channels(const Recording& record);

/// and one who takes a dead stretch within a channel for vibration.
std::string flaw_but_dead_stretches(const Recording& record);

}  // namespace rvbench::test
