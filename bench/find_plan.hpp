#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// The built-in plan of that name ("quick"), or the plan in that file.
std::variant<sequences::TestPlan, std::vector<hal::ConfigFault>> find_plan(
    const std::string& name_or_path);

}  // namespace rvbench::bench
