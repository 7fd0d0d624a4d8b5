#include "bench/limits_in_force.hpp"

#include <algorithm>
#include <optional>

#include "bench/fault_lines.hpp"
#include "bench/limits_versions.hpp"

namespace rvbench::bench {

std::variant<LimitsInForce, std::string> put_in_force(const std::filesystem::path& root,
                                                      const std::filesystem::path& plan_file,
                                                      sequences::TestPlan& plan) {
  auto active = active_limits(root, plan.name);
  if (active.index() == 1) return std::get<1>(std::move(active));
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
