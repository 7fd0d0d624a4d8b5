#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hal/rig.hpp"
#include "sequences/plan.hpp"
#include "tests/faults/fault_kind.hpp"

namespace rvbench::test {

/// One run of the campaign.
struct FaultCase {
  const FaultKind* kind = nullptr;  ///< nullptr: nothing goes wrong
  BenchState state = BenchState::recording;
  std::uint64_t seed = 1;
};

/// What one guard of the controller would have seen is taken away: a campaign must then find
/// violations, or it does not look at what that guard is for.
struct Guard {
  std::string name;
  std::function<void(sequences::TestPlan&, hal::Rig&)> switch_off;
};

const std::vector<Guard>& guards();

struct FaultReport {
  bool struck = false;  ///< the state was reached
  std::string outcome;  ///< with its reason
  std::vector<std::string> violations;
  double undriven_s = not_known;  ///< from the fault to nobody driving the shaft
  double released_s = not_known;  ///< from standstill to no torque commanded at the brake
};

/// Runs the sequencer over a FaultBench in virtual time, lets the bench alone afterwards, and
/// judges by what the plant did.
/// @param without  nullptr: every guard is in force
FaultReport run_fault(const FaultCase& fault, const Guard* without = nullptr);

}  // namespace rvbench::test
