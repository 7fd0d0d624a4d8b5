#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hal/rig.hpp"
#include "sequences/plan.hpp"
#include "tests/faults/record_flaw.hpp"

namespace rvbench::test {

class KeptRecording;

/// What judges a run besides its plan: all that a guard can be taken from.
struct Controller {
  sequences::TestPlan& plan;
  hal::Rig& rig;
  RecordCheck& check;
  KeptRecording& recording;
  std::function<void()> forget_to_drain;  ///< puts make_undrained_drive() in the driver's place
};

/// What one guard of the controller would have seen is taken away: a campaign must then find
/// violations, or it does not look at what that guard is for.
struct Guard {
  std::string name;
  std::function<void(Controller&)> switch_off;
};

const std::vector<Guard>& guards();

/// In groups, by what they look at.
std::vector<Guard> guards_of_the_drive();
std::vector<Guard> guards_of_the_field();

}  // namespace rvbench::test
