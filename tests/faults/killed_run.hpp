#pragma once

#include "tests/faults/fault_run.hpp"

namespace rvbench::test {

/// Runs in a process of its own, which gets a SIGKILL when the fault strikes. The plant goes on
/// without it, and is judged; so is what the dead process left on the disk.
/// @param file  the recording, in a folder of its own
FaultReport run_killed(const FaultCase& fault, const std::filesystem::path& file,
                       const Guard* without);

}  // namespace rvbench::test
