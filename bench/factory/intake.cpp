#include "bench/factory/intake.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "bench/factory/result_message.hpp"
#include "bench/result_database.hpp"

namespace rvbench::bench {
namespace {

Result<std::vector<RunRow>> entered_in(Result<ResultDatabase> database) {
  if (!database) return database.error();
  ResultDatabase results = std::move(database).value();
  const auto caught_up = results.catch_up();
  if (!caught_up) return caught_up.error();
  return results.runs();
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
  std::error_code error;
  using Entries = std::filesystem::directory_iterator;
  for (Entries serial(root_, error), end; !error && serial != end; serial.increment(error)) {
    std::error_code unreadable;
    for (Entries run(serial->path(), unreadable); !unreadable && run != end;
         run.increment(unreadable)) {
      std::error_code none;
      const auto time = std::filesystem::last_write_time(run->path() / "SHA256SUMS", none);
      if (!none) times.emplace(run->path(), time);
    }
  }
  const bool changed = !has_looked_ || times != seen_;
  has_looked_ = true;
  seen_ = std::move(times);
  return changed;
}

}  // namespace rvbench::bench
