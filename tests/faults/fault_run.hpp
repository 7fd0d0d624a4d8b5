#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/faults/fault_kind.hpp"
#include "tests/faults/guard.hpp"

namespace rvbench::test {

/// One run of the campaign.
struct FaultCase {
  const FaultKind* kind = nullptr;  ///< nullptr: nothing goes wrong
  BenchState state = BenchState::recording;
  std::uint64_t seed = 1;
};

struct FaultReport {
  bool struck = false;   ///< the state was reached
  bool held_up = false;  ///< by the computer: it proves nothing, and is to be done again
  std::string outcome;   ///< with its reason
  std::vector<std::string> violations;
  double undriven_s = not_known;  ///< from the fault to nobody driving the shaft
  double released_s = not_known;  ///< from true standstill, or the time-out, to the brake let go
};

/// Runs the sequencer over a FaultBench in virtual time, lets the bench alone afterwards, and
/// judges by what the plant did.
/// @param folder   for the recording
/// @param without  nullptr: every guard is in force
FaultReport run_fault(const FaultCase& fault, const std::filesystem::path& folder,
                      const Guard* without = nullptr);

}  // namespace rvbench::test
