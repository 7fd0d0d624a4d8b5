#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/survival/witness.hpp"

namespace rvbench::test {

/// What was found in the run folders below `root` after a crash, held against what had been
/// promised; then the run was resumed, came to its end, and was looked at again.
struct Aftermath {
  int acknowledged_lost = 0;  ///< points, run folders and verdicts
  double stream_lost_s = 0;   ///< real time since the first block lost was handed over
  int blocks_lost = 0;        ///< handed over since then, that one included
  bool opens = true;          ///< every recording of the run
  bool resume_offered = true;
  std::vector<std::string> violations;  ///< of all kinds, in words
};

/// What of the care that is taken a campaign does without: it must then find violations, or it does
/// not look at what that is for.
enum class Without { nothing, journal, syncs };

/// @param end_ns  when the crash came
Aftermath examine_aftermath(const std::filesystem::path& root, const Witness& witness,
                            std::int64_t end_ns);

}  // namespace rvbench::test
