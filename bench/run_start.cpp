#include "bench/run_start.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bench/json_text.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"
#include "hal/lock_alone.hpp"

namespace rvbench::bench {
namespace {

// Somebody works in the folder while this is locked.
std::filesystem::path log_of(const std::filesystem::path& folder) { return folder / "log.jsonl"; }

// However they are laid out, and in whatever order their keys are.
bool say_the_same(const nlohmann::json& a, const std::string& b) {
  return a == json_or_discarded(b);
}

}  // namespace

bool is_at_work(const std::filesystem::path& folder) {
  return hal::is_locked(log_of(folder)).value_or(false);
}

std::optional<FileLock> lock_run(const std::filesystem::path& folder) {
  // The lock that runs hold, where there is that file; no other is made in a run's folder.
  std::error_code unknown;
  const bool has_log = std::filesystem::exists(log_of(folder), unknown);
  return FileLock::take(has_log ? log_of(folder) : folder / "verdict.json");
}

RunPlace begin_run(const std::filesystem::path& root, const std::string& serial,
                   const ResolvedFiles& resolved) {
  const RunBegin begin = next_run(root, serial, utc_now());
  RunPlace place{create_run_folder(root, serial, begin.started_utc), std::nullopt};
  try {
    place.lock = FileLock::take(log_of(place.folder));
    write_file(place.folder / "start.json", run_begin_to_json(begin));
    for (const auto& [name, text] : resolved) write_file(place.folder / name, text);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove_all(place.folder, ignored);  // a run that never began
    throw;
  }
  return place;
}

std::variant<RunPlace, std::string> resume_run(const std::filesystem::path& root,
                                               const std::string& serial,
                                               const ResolvedFiles& resolved) {
  const auto newest = newest_unfinished_run(root, serial);
  if (!newest) return serial + " has no unfinished run to resume";
  RunPlace place{*newest, FileLock::take(log_of(*newest))};
  if (!place.lock) {
    return "another rvbench is at work in " + newest->string() + ": wait for its end, or stop it";
  }
  // Asked again: it may have come to its end just before the lock was free.
  if (newest_unfinished_run(root, serial) != newest) {
    return serial + " has no unfinished run to resume";
  }
  for (const auto& [name, text] : resolved) {
    const auto there = read_file(place.folder / name);
    if (there == text) continue;
    const auto said = json_or_discarded(there.value_or(""));
    if (said.is_discarded()) {
      return (place.folder / name).string() + " is damaged: nobody knows what the run was";
    }
    if (say_the_same(said, text)) continue;
    return (place.folder / name).string() + " says something else; resume with what it says";
  }
  return place;
}

}  // namespace rvbench::bench
