#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/formats/si_unit.hpp"
#include "hal/types/frequency_response.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// Brings values that are as in the file into SI, names their units, and notes what was done.
void apply_units(const UnitRatio& units, FrequencyResponse& response);

/// The same for one channel. @param unit  as the file spells it, kept so if it is not known here
void apply_unit(std::string_view unit, Channel& channel, std::vector<std::string>& notes);

/// The same where the unit is known.
void apply_unit(const SiUnit& unit, Channel& channel, std::vector<std::string>& notes);

}  // namespace rvbench::hal::formats
