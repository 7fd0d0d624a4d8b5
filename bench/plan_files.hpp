#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/types/embedded_file.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// The plans of sequences/plans, built in.
const std::vector<EmbeddedFile>& plan_files();

/// The built-in plan of that name ("quick"), or the plan in that file.
std::variant<sequences::TestPlan, std::vector<hal::ConfigFault>> find_plan(
    const std::string& name_or_path);

}  // namespace rvbench::bench
