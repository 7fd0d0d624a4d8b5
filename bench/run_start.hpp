#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bench/file_lock.hpp"

namespace rvbench::bench {

/// A run folder to work in, with its lock.
struct RunPlace {
  std::filesystem::path folder;
  std::optional<FileLock> lock;  ///< on log.jsonl
};

/// Names and texts of the files that say what is run: rig.json, kinematics.json, plan.json.
using ResolvedFiles = std::vector<std::pair<std::string, std::string>>;

/// Makes a new run folder that holds these files. plan.json must come last: a folder without is
/// none to resume.
/// @throws std::system_error
RunPlace begin_run(const std::filesystem::path& root, const std::string& serial,
                   const ResolvedFiles& resolved);

/// What to say of a run in whose folder a process works.
inline constexpr const char* still_at_work = "an rvbench is still at work in it: wait for its end";

/// Whether a process works in that run folder now.
bool is_at_work(const std::filesystem::path& folder);

/// For whoever adds files to a run that has come to its end. @return nullopt if another is at work
/// @throws std::system_error
std::optional<FileLock> lock_run(const std::filesystem::path& folder);

/// The newest unfinished run of that serial, or why it cannot be resumed: there is none, another
/// process works in it, or it was begun with other files than these.
/// @throws std::system_error
std::variant<RunPlace, std::string> resume_run(const std::filesystem::path& root,
                                               const std::string& serial,
                                               const ResolvedFiles& resolved);

}  // namespace rvbench::bench
