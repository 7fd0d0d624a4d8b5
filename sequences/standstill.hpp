#pragma once

#include <optional>

#include "hal/types/outcome.hpp"
#include "sequences/bench_devices.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// How the shaft ran down.
struct RunDown {
  bool stopped = false;           ///< standstill was measured
  std::optional<Ending> trouble;  ///< what befell the bench meanwhile: a trip, a lost device
};

/// Lets the stopped shaft run down and keeps the brake's load on, until standstill is measured or
/// the teardown's time-out has passed. Devices that do not answer are no reason to leave early:
/// with a dead link the drive stops by its own watchdog.
///
/// Standstill is what the angle says, or the drive if the angle is lost; if both answer, both.
RunDown wait_for_standstill(hal::Rig& rig, BenchDevices& devices, const TestPlan& plan,
                            double brake_torque_Nm);

}  // namespace rvbench::sequences
