#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// By which limits a run of a plan is judged.
struct LimitsInForce {
  std::string version;         ///< empty: the plan's own
  std::filesystem::path file;  ///< that states them
};

/// Puts the active limits of the plan's name in place of its own, where there are any.
/// @param root  folder of runs  @param plan_file  that states the plan
/// Errors  why there are active limits that must not be used: active_limits(), or that results.db
///         knows of some that the ledger has lost
std::variant<LimitsInForce, std::string> put_in_force(const std::filesystem::path& root,
                                                      const std::filesystem::path& plan_file,
                                                      sequences::TestPlan& plan);

/// "limits 2026-11 are active, in place of the plan's"; empty of the plan's own.
std::string note_of(const LimitsInForce& limits);

/// Each fault with its file, and with its line if that can be had: those at "/limits" are of the
/// file that states the limits in force, all others of the plan's.
std::vector<std::pair<std::filesystem::path, std::vector<hal::ConfigFault>>> faults_by_file(
    std::vector<hal::ConfigFault> faults, const std::filesystem::path& plan_file,
    const LimitsInForce& limits);

}  // namespace rvbench::bench
