#pragma once

#include <string>
#include <vector>

#include "hal/config_reader.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// The limits of a plan, or of a limits file: what stands at its key "limits".
/// Errors  faults of `root`, as of any other key
std::vector<Limit> parse_limits(hal::ConfigReader& root);

/// The inverse: a JSON array.
std::string limits_to_json(const std::vector<Limit>& limits);

}  // namespace rvbench::sequences
