#pragma once

#include <optional>
#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// Notes which channels are no accelerations, by their units, which nobody judges, and takes out
/// those that only rise; but for `kept`. @return why the recording cannot be judged: see
/// leave_out_rising_channels()
std::optional<std::string> leave_out_what_is_no_acceleration(const std::string& kept,
                                                             Recording& record);

}  // namespace rvbench::bench
