#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/limits_file.hpp"

/// Versions of limits beside the runs that they are for: <root>/limits/<version>.json. A draft is
/// proposed, approved by somebody with a name, and activated; rvbench run takes the active one of
/// its plan in place of the limits that the plan states.
namespace rvbench::bench {

/// Letters, digits, '.', '_' and '-', at most 64, the first no '.': the name of a file.
bool is_limits_version(const std::string& version);

std::filesystem::path limits_path(const std::filesystem::path& root, const std::string& version);

/// All that can be read, by version.
std::vector<LimitsFile> limits_versions(const std::filesystem::path& root);

/// The newest step of that name; null if there is none.
const LimitsStep* last_step(const LimitsFile& file, const std::string& step);

/// "draft", "approved" or "activated": how far it has come. What was changed since its approval is
/// a draft again.
std::string status_of(const LimitsFile& file);

/// The one of that plan that was activated last; nothing if none was, or why it must not be used:
/// it cannot be read, or was changed since it was approved.
std::variant<std::optional<LimitsFile>, std::string> active_limits(
    const std::filesystem::path& root, const std::string& plan);

}  // namespace rvbench::bench
