#pragma once

#include <memory>

#include "hal/config_reader.hpp"
#include "sequences/phase.hpp"

namespace rvbench::sequences {

/// The longest time-out of a drive's watchdog that a bench is armed with, whatever a plan says.
inline constexpr double longest_watchdog_s = 2;

/// Connects every device, looks at the safety inputs, and arms only if the drive's own watchdog
/// would stop the motor within `watchdog_max_s` of silence.
std::unique_ptr<Phase> parse_connect(hal::ConfigReader& json);

}  // namespace rvbench::sequences
