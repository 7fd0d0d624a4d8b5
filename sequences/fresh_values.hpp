#pragma once

#include <optional>
#include <vector>

#include "hal/accelerometers.hpp"
#include "hal/brake.hpp"
#include "hal/drive.hpp"
#include "hal/safety_inputs.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::sequences {

/// What came in since somebody looked last: the newest status of each device that answered, every
/// sample of the streams.
struct FreshValues {
  std::optional<hal::DriveStatus> drive;
  std::optional<hal::BrakeStatus> brake;
  std::optional<hal::SafetyStatus> safety;
  std::optional<hal::TorqueBlock> torque;
  std::optional<hal::AccelerationBlock> accelerations;
  double torque_rate_Hz = 0;
  double acceleration_rate_Hz = 0;
  double speed_rpm = not_known;       ///< by the angle, over the last 10 ms
  double angle_s = not_known;         ///< time of angle_rad on the rig's clock
  double angle_rad = not_known;       ///< the newest, of the input shaft
  double torque_mean_Nm = not_known;  ///< of the block, at the input
};

/// What came in one round after the other, as if it had come in one.
FreshValues merged(std::vector<FreshValues> rounds);

}  // namespace rvbench::sequences
