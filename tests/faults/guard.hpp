#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
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

/// A guard that goes by what one device tells: it is shown what `Shown` leaves of that.
template <typename Shown, typename Device>
Guard shown_by(std::string name, std::unique_ptr<Device> hal::Rig::*device) {
  return {std::move(name), [device](Controller& controller) {
            std::unique_ptr<Device>& behind = controller.rig.*device;
            behind = std::make_unique<Shown>(std::move(behind));
          }};
}

const std::vector<Guard>& guards();

/// In groups, by what they look at.
std::vector<Guard> guards_of_the_drive();
std::vector<Guard> guards_of_the_field();

}  // namespace rvbench::test
