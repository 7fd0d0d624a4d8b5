#include "bench/results/unentered_runs.hpp"

#include <set>
#include <string>
#include <system_error>

#include "bench/run_folder.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

bool has_file(const std::filesystem::path& folder, const char* name) {
  std::error_code unknown;
  return std::filesystem::exists(folder / name, unknown);
}

std::string why_without_sums(const std::filesystem::path& folder) {
  if (is_at_work(folder)) return "not finished: still at work";
  return has_file(folder, "verdict.json")
             ? "it has a verdict.json but no SHA256SUMS: cut short while its results were written, "
               "or they were taken away"
             : "not finished: cut short";
}

RunRow row_without_result(const std::filesystem::path& root, const std::filesystem::path& folder,
                          const std::string& reason) {
  const RunBegin begin = read_run_begin(folder);
  return {.folder = folder.lexically_relative(root).string(),
          .serial = begin.serial,
          .started_utc = begin.started_utc,
          .plan = plan_name_in(folder),
          .reason = reason,
          .number = begin.number};
}

}  // namespace

std::vector<RunRow> unfinished_runs(const std::filesystem::path& root) {
  std::vector<RunRow> rows;
  for (const std::filesystem::path& folder : run_folders(root)) {
    if (has_sums(folder) || !has_file(folder, "plan.json")) continue;
    rows.push_back(row_without_result(root, folder, why_without_sums(folder)));
  }
  return rows;
}

std::vector<RunRow> damaged_runs(const std::filesystem::path& root,
                                 const std::vector<RunRow>& entered) {
  std::set<std::string> known;
  for (const RunRow& row : entered) known.insert(row.folder);
  std::vector<RunRow> rows;
  for (const std::filesystem::path& folder : run_folders(root)) {
    if (known.contains(folder.lexically_relative(root).string())) continue;
    if (!has_sums(folder) || !has_file(folder, "plan.json") || judgement_in(folder)) continue;
    rows.push_back(row_without_result(
        root, folder, "its verdict.json is damaged: rvbench check tells what else"));
  }
  return rows;
}

}  // namespace rvbench::bench
