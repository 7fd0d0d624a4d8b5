#include "bench/run_start.hpp"

#include "bench/run_folder.hpp"

namespace rvbench::bench {

RunPlace begin_run(const std::filesystem::path& root, const std::string& serial,
                   const ResolvedFiles& resolved) {
  RunPlace place{create_run_folder(root, serial, utc_now()), std::nullopt};
  place.lock = RunLock::take(place.folder);
  for (const auto& [name, text] : resolved) write_file(place.folder / name, text);
  return place;
}

std::variant<RunPlace, std::string> resume_run(const std::filesystem::path& root,
                                               const std::string& serial,
                                               const ResolvedFiles& resolved) {
  const auto newest = newest_unfinished_run(root, serial);
  if (!newest) return serial + " has no unfinished run to resume";
  RunPlace place{*newest, RunLock::take(*newest)};
  if (!place.lock) {
    return "another rvbench is at work in " + newest->string() + ": wait for its end, or stop it";
  }
  // Asked again: it may have come to its end just before the lock was free.
  if (newest_unfinished_run(root, serial) != newest) {
    return serial + " has no unfinished run to resume";
  }
  for (const auto& [name, text] : resolved) {
    if (read_file(place.folder / name) == text) continue;
    return (place.folder / name).string() + " says something else; resume with what it says";
  }
  return place;
}

}  // namespace rvbench::bench
