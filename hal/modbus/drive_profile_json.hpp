#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/modbus/drive_profile.hpp"

namespace rvbench::hal {

/// The built-in profiles, in order of their names.
std::vector<std::string> drive_names();

/// Reads a built-in profile by its name, or a file of one's own by its path.
/// hal/modbus/drives/README.md tells the keys.
/// @return everything that is wrong with it instead
std::variant<DriveProfile, std::vector<ConfigFault>> read_drive_profile(const std::string& drive);

/// A built-in profile.
/// @throws std::invalid_argument if there is none of that name
DriveProfile drive_profile(const std::string& name);

}  // namespace rvbench::hal
