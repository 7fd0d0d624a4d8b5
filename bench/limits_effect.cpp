#include "bench/limits_effect.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "bench/console.hpp"
#include "bench/rejudging.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/stored_run.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

constexpr int longest_reason = 500;

}  // namespace

LimitsEffect effect_of(const LimitsFile& limits, const std::filesystem::path& root,
                       const std::vector<RunRow>& runs,
                       const std::function<void(double)>& progress) {
  LimitsEffect effect;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].plan != limits.plan) continue;
    progress(double(i) / double(runs.size()));
    const auto read = read_stored_run(root / runs[i].folder);
    const auto* stored = std::get_if<StoredRun>(&read);
    if (stored == nullptr || !why_not_judged_again(*stored).empty()) {
      ++effect.left_out;
      continue;
    }
    ++effect.runs;
    const auto [before, after] = endings_by_limits(*stored, limits.limits);
    if (before.outcome == after.outcome) continue;
    VerdictChange change{runs[i], to_string(after.outcome), after.reason};
    change.run.verdict = to_string(before.outcome);
    effect.changes.push_back(std::move(change));
  }
  return effect;
}

std::string effect_text(const LimitsEffect& effect) {
  std::map<std::string, int> counts;
  for (const VerdictChange& change : effect.changes) {
    ++counts[change.run.verdict + " to " + change.verdict];
  }
  std::string kinds;
  for (const auto& [kind, count] : counts) {
    kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", count, kind);
  }
  std::string text =
      fmt::format("{} of {} verdicts would change{}\n", effect.changes.size(), effect.runs, kinds);
  for (const VerdictChange& change : effect.changes) {
    text += fmt::format("  {}  {}  {} to {}: {}\n", readable_utc(change.run.started_utc),
                        as_cell(change.run.serial, 32), change.run.verdict, change.verdict,
                        as_cell(change.reason, longest_reason));
  }
  if (effect.left_out > 0) {
    text += fmt::format("  left out: {} runs that ended ERROR or ABORTED, or cannot be read\n",
                        effect.left_out);
  }
  return text;
}

nlohmann::ordered_json effect_json(const LimitsEffect& effect) {
  auto changes = nlohmann::ordered_json::array();
  for (const VerdictChange& change : effect.changes) {
    changes.push_back(hal::json_object({{"folder", change.run.folder},
                                        {"was", change.run.verdict},
                                        {"would_be", change.verdict},
                                        {"reason", change.reason}}));
  }
  return hal::json_object(
      {{"runs", effect.runs}, {"left_out", effect.left_out}, {"changes", changes}});
}

}  // namespace rvbench::bench
