#pragma once

#include <filesystem>

#include "analysis/kinematics.hpp"
#include "bench/run_folder.hpp"

namespace rvbench::bench {

/// verdict.json, junit.xml, report.html and SHA256SUMS of a run folder.
/// @throws std::system_error if one of them cannot be written
void write_results(const std::filesystem::path& folder, const Judgement& judgement,
                   const analysis::Kinematics& kinematics);

/// report.html alone, out of what the folder holds.
/// @throws std::system_error if it cannot be written
void write_report(const std::filesystem::path& folder, const Judgement& judgement,
                  const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench
