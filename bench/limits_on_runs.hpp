#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/limits_file.hpp"
#include "hal/config_reader.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// Why no run could be held against the limits: faults at "/limits", none if one can; or in words,
/// where nobody knows their plan.
/// @param root       folder of runs, of which the latest of the plan tells what it is; else it is
///                   the built-in one
/// @param plan_file  in place of that where it is of this name; may be empty
std::variant<std::vector<hal::ConfigFault>, std::string> faults_on_runs(
    const LimitsFile& limits, const std::filesystem::path& root, const std::string& plan_file);

/// The plan of that name: of the latest run that has it, or the built-in one.
std::optional<sequences::TestPlan> plan_of_runs(const std::filesystem::path& root,
                                                const std::string& name);

}  // namespace rvbench::bench
