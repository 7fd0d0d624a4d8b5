#pragma once

#include <memory>
#include <vector>

#include "bench/qualification/self_test_step.hpp"

namespace rvbench::bench {

/// The name of the step that may be left out: nobody may be there to tap.
inline constexpr std::string_view tap_step = "tap";

/// All steps in their order: what can be told of a bench at rest comes first.
std::vector<std::unique_ptr<SelfTestStep>> self_test_steps();

// One a file of steps/.
std::unique_ptr<SelfTestStep> make_sensor_noise();
std::unique_ptr<SelfTestStep> make_sensor_bias();
std::unique_ptr<SelfTestStep> make_tap();
std::unique_ptr<SelfTestStep> make_drive_read_back();
std::unique_ptr<SelfTestStep> make_brake_read_back();

}  // namespace rvbench::bench
