#pragma once

#include "sequences/bench_devices.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// Lets the stopped shaft run down and keeps the brake's load on, until standstill is measured or
/// the teardown's time-out has passed. Devices that do not answer are no reason to leave early:
/// with a dead link the drive stops by its own watchdog.
///
/// Standstill is what the angle says, or the drive if the angle is lost; if both answer, both.
/// @return true if standstill was measured
bool wait_for_standstill(hal::Rig& rig, BenchDevices& devices, const Teardown& teardown,
                         double brake_torque_Nm);

}  // namespace rvbench::sequences
