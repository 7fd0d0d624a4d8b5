#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rvbench::bench {

/// A run of a unit that has been on the bench before.
struct KnownRun {
  std::string run;  ///< below the folder of runs: "A17/20260102T030405Z"
  std::string started_utc;
  std::string verdict;  ///< "" if it has none
  int number = 0;       ///< among those of the unit, from 1
};

/// Of that serial number, in the order in which they began.
std::vector<KnownRun> known_runs(const std::filesystem::path& root, const std::string& serial);

}  // namespace rvbench::bench
