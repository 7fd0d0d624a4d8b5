#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>

#include "bench/progress_bar.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// How the virtual robot is measured. One seed is one robot, one session, one set of motions.
struct SimulatedSession {
  std::uint64_t seed = 1;
  double rate_Hz = 4960;  ///< at least 2000
  double record_s = 20;   ///< of each motion
  double hit_s = 4;       ///< of each hit: until the arm is at rest
  int hits = 10;          ///< at each path
  bool with_reducer = true;
};

/// Measures the virtual robot and writes what a test engineer would bring home, and nothing that
/// only the simulation knows: raw hits at 18 paths (some of them bad), three motions before and
/// after joint 3's reducer was replaced, both reducers on the bench, and project.json for it all.
/// @return why not: a file that exists or cannot be written
/// @throws Interrupted, std::invalid_argument if the session makes no sense
Status write_virtual_robot(const std::filesystem::path& folder, const SimulatedSession& session,
                           ProgressBar& bar, const std::stop_token& stop);

}  // namespace rvbench::bench
