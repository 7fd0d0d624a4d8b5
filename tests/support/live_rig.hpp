#pragma once

#include <atomic>
#include <memory>

#include "hal/clock.hpp"
#include "hal/rig.hpp"

namespace rvbench::test {

/// A bench in real time with next to no physics: the shaft follows its command by a ramp. Whatever
/// is atomic may be changed, or looked at, from any thread.
struct LiveBench final : hal::Backstage {
  explicit LiveBench(hal::Clock& of) : clock(of) {}

  hal::Clock& clock;
  std::atomic<bool> estop = false;
  std::atomic<bool> drive_hangs = false;   ///< its calls take 50 ms and fail
  std::atomic<bool> stop_is_slow = false;  ///< it takes 50 ms
  std::atomic<double> torque_Nm = 1.0;
  std::atomic<double> setpoint_rpm = 0;
  std::atomic<int> stops = 0;
  std::atomic<double> stopped_s = -1;  ///< when stop() was called last
  std::atomic<double> brake_Nm = 0;
  std::atomic<int> brake_commands = 0;
};

LiveBench& live_bench(hal::Rig& rig);

/// @param ramp_rpm_s  of the drive
hal::Rig make_live_rig(double ramp_rpm_s = 20'000);

}  // namespace rvbench::test
