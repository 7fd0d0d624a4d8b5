#pragma once

#include <string>

namespace rvbench {

/// @throws std::invalid_argument naming `where`, `name` and the value if that is not finite and
///         above 0: "CanBrake: poll_s is -1, must be finite and above 0"
void require_positive(double value, const std::string& where, const std::string& name);

}  // namespace rvbench
