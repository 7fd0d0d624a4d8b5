#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/types/embedded_file.hpp"

namespace rvbench::bench {

/// "station", "plan", "rig", "kinematics", "plant", "campaign", "tpa", "limits" or "broker", by the
/// key that only this kind of file has; empty if none.
std::string file_kind(const hal::ConfigReader& root);

/// The fault of a file that was given as a `wanted` and seems to be another kind.
std::optional<hal::ConfigFault> other_kind_fault(const hal::ConfigReader& root,
                                                 const std::string& wanted);

/// Whether nothing is there. What cannot even be looked at (a closed folder, a loop of links) is
/// left to whoever opens it and tells why.
bool is_absent(const std::filesystem::path& file);

std::vector<std::string> names_of(const std::vector<EmbeddedFile>& files);

}  // namespace rvbench::bench
