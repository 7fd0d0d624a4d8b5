#pragma once

#include <filesystem>

#include "hal/rig.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

struct ReplayOptions {
  double rated_output_torque_Nm = 167;  ///< what 100 % load means on the brake
  double lead_in_s = 2.0;  ///< played before a point's first sample: what settling takes away
  bool real_time = false;  ///< at the pace at which it was recorded, else as fast as it is read
};

/// A recording played as if it were hardware, in virtual time or at the pace of real time.
///
/// In real time the rig's clock is the steady one, not a virtual one made to follow it: whoever
/// reads late meets more samples, as with hardware, so that latency and live views can be tried.
///
/// Commands choose what is played: the recorded point nearest to the commanded speed and brake
/// torque, of repeats the next in the order of the recording, so that the same plan meets the same
/// points. Speed 0 is standstill. There are no ramps: a new speed is reached at once.
///
/// Errors  if the file cannot be read, or no point holds acceleration, torque and angle
Result<Rig> make_replay_rig(const std::filesystem::path& file, const ReplayOptions& options = {});

}  // namespace rvbench::hal
