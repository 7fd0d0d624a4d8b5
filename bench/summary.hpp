#pragma once

#include <filesystem>

#include "analysis/kinematics.hpp"
#include "bench/console.hpp"
#include "bench/judgement.hpp"

namespace rvbench::bench {

/// The judgement for a reader at a terminal: what is wrong with the data, lines that nothing
/// explains, findings with their evidence, and last, where it stays in sight, verdict, reason and
/// the report's path.
/// @param folder  where report.html is; empty: none was made
void print_summary(Console& console, const Judgement& judgement,
                   const analysis::Kinematics& kinematics, const std::filesystem::path& folder);

/// The same in at most ten lines: verdict, reason, the limits that are nearest to what was measured
/// or exceeded by it, and the report's path.
void print_brief(Console& console, const Judgement& judgement, const std::filesystem::path& folder);

/// Result files that are missing, and why, on standard error.
void print_unwritten(Console& console, const Judgement& judgement);

}  // namespace rvbench::bench
