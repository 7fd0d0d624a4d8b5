#pragma once

#include <filesystem>
#include <vector>

#include "bench/result_database.hpp"

/// Runs that results.db cannot hold, as their verdict is empty; of what each recorded when it
/// began.
namespace rvbench::bench {

/// Those below the root that have no result (yet).
std::vector<RunRow> unfinished_runs(const std::filesystem::path& root);

/// Those that have come to their end, but whose verdict is not the one of then, or cannot be read,
/// nor has it been entered.
std::vector<RunRow> damaged_runs(const std::filesystem::path& root,
                                 const std::vector<RunRow>& entered);

}  // namespace rvbench::bench
