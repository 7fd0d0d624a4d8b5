#include "bench/limits_on_runs.hpp"

#include <functional>
#include <map>
#include <utility>

#include "bench/find_plan.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/run_folder.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

using Faults = std::vector<hal::ConfigFault>;
using sequences::TestPlan;

std::optional<TestPlan> if_named(const std::string& name, std::variant<TestPlan, Faults> plan) {
  if (plan.index() == 1 || std::get<0>(plan).name != name) return std::nullopt;
  return std::get<0>(std::move(plan));
}

}  // namespace

std::optional<TestPlan> plan_of_runs(const std::filesystem::path& root, const std::string& name) {
  std::map<std::string, std::filesystem::path, std::greater<>> runs;  // by when they began
  for (const std::filesystem::path& run : run_folders(root)) {
    if (plan_name_in(run) == name) runs[read_run_begin(run).started_utc] = run;
  }
  for (const auto& [began, run] : runs) {
    if (auto plan = if_named(name, sequences::read_plan(run / "plan.json"))) return plan;
  }
  return if_named(name, find_plan(name));
}

std::variant<Faults, std::string> faults_on_runs(const LimitsFile& limits,
                                                 const std::filesystem::path& root,
                                                 const std::string& plan_file) {
  std::optional<TestPlan> plan;
  if (!plan_file.empty()) plan = if_named(limits.plan, find_plan(plan_file));
  if (!plan) plan = plan_of_runs(root, limits.plan);
  if (!plan) {
    return limits.version + " is for plan " + hal::in_quotes(limits.plan) +
           ", which is neither that of a run in " + root.string() + " nor built in" +
           (plan_file.empty() ? "" : ", nor in " + plan_file) + ": give its file with --plan";
  }
  const auto kinematics = read_kinematics(plan->specimen.kinematics);
  if (kinematics.index() == 1) {
    return hal::describe(plan->specimen.kinematics, std::get<1>(kinematics).front());
  }
  return limits_out_of_place(limits.limits, *plan, std::get<0>(kinematics));
}

}  // namespace rvbench::bench
