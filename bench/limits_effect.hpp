#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/limits_file.hpp"
#include "bench/result_database.hpp"

namespace rvbench::bench {

/// A past run whose verdict would be another.
struct VerdictChange {
  RunRow run;
  std::string verdict;  ///< by the limits in question
  std::string reason;
};

/// What limits would have made of the runs of their plan.
struct LimitsEffect {
  std::size_t runs = 0;      ///< that were held against them
  std::size_t left_out = 0;  ///< of the plan, but ended ERROR or ABORTED, or cannot be read
  std::vector<VerdictChange> changes;  ///< oldest first
};

/// Holds the limits against what each past run of the plan measured. Both verdicts are drawn by
/// this version of rvbench, from the run's own limits and from these: what differs is of the limits
/// alone.
/// @param runs  of any plan, oldest first  @param progress  is told the share that is done
/// Units  of each limit. Errors  none thrown. Source  judged_by_limits()
LimitsEffect effect_of(const LimitsFile& limits, const std::filesystem::path& root,
                       const std::vector<RunRow>& runs,
                       const std::function<void(double)>& progress);

/// "3 of 120 verdicts would change: 2 PASS to FAIL, 1 FAIL to PASS", and a line each.
std::string effect_text(const LimitsEffect& effect);

/// {"runs", "left_out", "changes": [{"folder", "was", "would_be", "reason"}]}, numbers of runs.
nlohmann::ordered_json effect_json(const LimitsEffect& effect);

}  // namespace rvbench::bench
