#pragma once

#include <filesystem>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/kinematics.hpp"
#include "bench/judgement.hpp"
#include "hal/config_reader.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// A run that has come to its end, read from its folder.
struct StoredRun {
  std::filesystem::path folder;
  sequences::TestPlan plan;
  analysis::Kinematics kinematics;  ///< of the specimen, without the plan's limits
  Judgement as_judged;              ///< verdict.json
};

/// A file of a run folder, and what is wrong with it.
using FileFaults = std::pair<std::filesystem::path, std::vector<hal::ConfigFault>>;

/// Reads plan, machine and verdict of a run folder; checks no hash.
/// Errors  the first file that cannot be used, with its faults: also a run that is at work, or has
///         not come to its end
std::variant<StoredRun, FileFaults> read_stored_run(const std::filesystem::path& folder);

/// What differs between a run folder and its hashes, but for report.html, which can be made anew.
std::vector<std::string> changed_files(const std::filesystem::path& folder);

}  // namespace rvbench::bench
