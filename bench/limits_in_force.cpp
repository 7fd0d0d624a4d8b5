#include "bench/limits_in_force.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <system_error>

#include "bench/fault_lines.hpp"
#include "bench/ledger.hpp"
#include "bench/limits_versions.hpp"
#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

// Why the ledger is not the one that results.db goes with; "" if it is, or if nobody can tell.
std::string lost_limits(const std::filesystem::path& root, const std::string& plan) {
  std::error_code unknown;
  if (!std::filesystem::exists(root / result_database_name, unknown)) return "";
  const auto results = ResultDatabase::open(root);
  if (!results) return "";
  const auto versions = results.value().activated_limits(plan);
  if (!versions) return "";
  const std::set<std::string> known = activated_versions(root);
  for (const std::string& version : versions.value()) {
    if (known.contains(version)) continue;
    return "limits " + version + " of plan " + plan + " were activated, as " +
           result_database_name + " remembers, and " + ledger_name +
           " knows nothing of them: put back a copy of it and of " + limits_folder_name +
           "/, or approve and activate limits of that name anew";
  }
  return "";
}

}  // namespace

std::variant<LimitsInForce, std::string> put_in_force(const std::filesystem::path& root,
                                                      const std::filesystem::path& plan_file,
                                                      sequences::TestPlan& plan) {
  auto active = active_limits(root, plan.name);
  if (active.index() == 1) return std::get<1>(std::move(active));
  if (std::string lost = lost_limits(root, plan.name); !lost.empty()) return lost;
  std::optional<LimitsFile>& limits = std::get<0>(active);
  if (!limits) return LimitsInForce{"", plan_file};
  plan.limits = std::move(limits->limits);
  return LimitsInForce{limits->version, limits_path(root, limits->version)};
}

std::string note_of(const LimitsInForce& limits) {
  if (limits.version.empty()) return "";
  return "limits " + limits.version + " are active, in place of the plan's";
}

std::vector<std::pair<std::filesystem::path, std::vector<hal::ConfigFault>>> faults_by_file(
    std::vector<hal::ConfigFault> faults, const std::filesystem::path& plan_file,
    const LimitsInForce& limits) {
  const auto is_of_plan = [](const hal::ConfigFault& fault) {
    return !fault.pointer.starts_with("/limits/");
  };
  const auto others = std::stable_partition(faults.begin(), faults.end(), is_of_plan);
  std::vector<hal::ConfigFault> of_limits(others, faults.end());
  faults.erase(others, faults.end());
  return {{plan_file, with_lines(plan_file, std::move(faults))},
          {limits.file, with_lines(limits.file, std::move(of_limits))}};
}

}  // namespace rvbench::bench
