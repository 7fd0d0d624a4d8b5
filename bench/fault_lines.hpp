#pragma once

#include <filesystem>
#include <vector>

#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// Gives each fault that has none the line of its JSON pointer in the file, or of what is nearest
/// above it: for faults that were found after the file was read. Line 0 stays where the file cannot
/// be read.
std::vector<hal::ConfigFault> with_lines(const std::filesystem::path& file,
                                         std::vector<hal::ConfigFault> faults);

}  // namespace rvbench::bench
