#pragma once

#include <stdexcept>
#include <string_view>

#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// Notes at `key` why a device cannot be made of what the section says, in the file's own words:
/// without the name of the class that refused it.
void note_misfit(hal::ConfigReader& section, std::string_view key,
                 const std::invalid_argument& error);

}  // namespace rvbench::bench
