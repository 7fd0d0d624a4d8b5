#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/limits_versions.hpp"

namespace rvbench::bench {

/// A line each, with its steps; what is wrong with it below.
std::string limits_text(const std::vector<LimitsVersion>& versions);

/// {"versions": [...]}: each as its file, with "status" and "in_force", and "fault" where it has
/// one; of a file that cannot be read "limits_version" alone.
nlohmann::ordered_json limits_json(const std::vector<LimitsVersion>& versions);

}  // namespace rvbench::bench
