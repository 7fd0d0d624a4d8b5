#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "bench/ledger.hpp"
#include "bench/limits_file.hpp"

/// Versions of limits beside the runs that they are for: <root>/limits/<version>.json. A draft is
/// proposed, approved by somebody with a name, and activated, each step a line of the ledger;
/// rvbench run takes the active one of its plan in place of the limits that the plan states.
namespace rvbench::bench {

inline constexpr const char* limits_folder_name = "limits";

/// Letters, digits, '.', '_' and '-', at most 64, the first no '.': the name of a file.
bool is_limits_version(const std::string& version);

std::filesystem::path limits_path(const std::filesystem::path& root, const std::string& version);

/// The newest step of that name; null if there is none.
const LimitsStep* last_step(const LimitsFile& file, const std::string& step);

/// One version, as far as it has come.
struct LimitsVersion {
  std::string version;
  LimitsFile file;           ///< empty if it cannot be read
  std::string status;        ///< "draft", "approved", "activated", "damaged" or "missing"
  bool is_in_force = false;  ///< of its plan it was activated last; with a fault no run begins
  std::string fault;         ///< of a file that cannot be read, or differs from what was kept
};

/// All there are, by name, and those in force that are missing.
std::vector<LimitsVersion> limits_versions(const std::filesystem::path& root);

/// How far the version of a file that is read has come. What was changed since its approval, or is
/// not as it was kept, is a draft again.
std::string status_of(const LimitsFile& file, const std::filesystem::path& root);

/// The one of that plan that was activated last, whatever clocks said; nothing if none was, or why
/// no run may begin: it is missing, cannot be read, or was changed since it was approved, or
/// nobody can tell which was the last.
std::variant<std::optional<LimitsFile>, std::string> active_limits(
    const std::filesystem::path& root, const std::string& plan);

/// Whether there was ever a version of that name, be its file there or not.
bool was_kept(const std::filesystem::path& root, const std::string& version);

/// Those of which the ledger tells that they were ever activated.
std::set<std::string> activated_versions(const std::filesystem::path& root);

/// Keeps the version with a further step, which the caller has put at the end of its steps.
/// @throws std::system_error
void keep_limits(LedgerPen& pen, const LimitsFile& file);

}  // namespace rvbench::bench
