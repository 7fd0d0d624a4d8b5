#include "bench/factory/intake.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "bench/factory/result_message.hpp"
#include "bench/result_database.hpp"
#include "bench/results/unentered_runs.hpp"
#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

Result<std::vector<RunRow>> entered_in(Result<ResultDatabase> database) {
  const auto whole = caught_up(std::move(database));
  if (!whole) return whole.error();
  return whole.value().runs();
}

// From the folders themselves where results.db cannot be used.
Result<std::vector<RunRow>> judged_runs(const std::filesystem::path& root) {
  auto rows = entered_in(ResultDatabase::open(root));
  return rows ? std::move(rows) : entered_in(ResultDatabase::in_memory(root));
}

}  // namespace

Result<std::vector<SkippedRun>> take_in(const std::filesystem::path& root, const std::string& step,
                                        Outbox& outbox) {
  const auto judged = judged_runs(root);
  if (!judged) return judged.error();
  std::vector<SkippedRun> skipped;
  for (const RunRow& run : judged.value()) {
    const std::filesystem::path folder = root / run.folder;
    const std::string id = result_id_of(root, folder);
    if (id.empty()) continue;  // deleted since, or resumed just now
    const auto is_there = outbox.holds(id);
    if (!is_there) return is_there.error();
    if (is_there.value()) continue;
    const auto message = result_message(root, folder, step);
    if (!message) {
      skipped.push_back({run.folder, message.error().where});
      continue;
    }
    if (const Status entered = outbox.enter(message.value()); !entered) return entered.error();
  }
  for (const RunRow& run : damaged_runs(root, judged.value())) {
    skipped.push_back({run.folder, run.reason});
  }
  return skipped;
}

bool RunWatch::has_changed() {
  Times times;
  for (const std::filesystem::path& run : run_folders(root_)) {
    std::error_code none;
    const auto time = std::filesystem::last_write_time(run / "SHA256SUMS", none);
    if (!none) times.emplace(run, time);
  }
  const bool changed = !has_looked_ || times != seen_;
  has_looked_ = true;
  seen_ = std::move(times);
  return changed;
}

}  // namespace rvbench::bench
