#include "bench/stored_run.hpp"

#include <string>
#include <system_error>

#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

// The machine as it was when the run began; what the plan names may have changed since.
std::string machine_of(const std::filesystem::path& folder, const sequences::TestPlan& test) {
  const std::filesystem::path own = folder / "kinematics.json";
  return std::filesystem::exists(own) ? own.string() : test.specimen.kinematics;
}

FileFaults whole(const std::filesystem::path& file, const std::string& what) {
  return {file, {{0, "", what}}};
}

}  // namespace

std::variant<StoredRun, FileFaults> read_stored_run(const std::filesystem::path& folder) {
  auto plan = sequences::read_plan(folder / "plan.json");
  if (plan.index() == 1) return FileFaults{folder / "plan.json", std::get<1>(std::move(plan))};
  sequences::TestPlan& test = std::get<0>(plan);
  const std::string machine = machine_of(folder, test);
  auto kinematics = read_kinematics(machine);
  if (kinematics.index() == 1) return FileFaults{machine, std::get<1>(std::move(kinematics))};
  if (is_at_work(folder)) return whole(folder, still_at_work);
  const auto text = read_file(folder / "verdict.json");
  if (!text && !has_sums(folder)) {
    return whole(folder, "the run has not come to its end: rvbench run --resume goes on with it");
  }
  auto judgement = judgement_from_json(text.value_or(""));
  if (!judgement) {
    return whole(folder / "verdict.json", text ? "is no verdict" : "cannot be read");
  }
  analysis::Kinematics own = of_specimen(std::get<0>(std::move(kinematics)), test.specimen);
  return StoredRun{folder, std::move(test), std::move(own), *std::move(judgement)};
}

std::vector<std::string> changed_files(const std::filesystem::path& folder) {
  std::vector<std::string> faults = verify_sums(folder);
  std::erase_if(faults, [](const std::string& f) { return f.starts_with("report.html:"); });
  return faults;
}

}  // namespace rvbench::bench
