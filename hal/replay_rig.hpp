#pragma once

#include <filesystem>

#include "hal/rig.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

struct ReplayOptions {
  double rated_output_torque_Nm = 167;  ///< what 100 % load means on the brake
  double lead_in_s = 2.0;  ///< played before a point's first sample: what settling takes away
};

/// A recording played as if it were hardware, in virtual time.
///
/// Commands choose what is played: the recorded point nearest to the commanded speed and brake
/// torque, of repeats the next in the order of the recording, so that the same plan meets the same
/// points. Speed 0 is standstill. There are no ramps: a new speed is reached at once.
///
/// Errors  if the file cannot be read, or no point holds acceleration, torque and angle
Result<Rig> make_replay_rig(const std::filesystem::path& file, const ReplayOptions& options = {});

}  // namespace rvbench::hal
