#include "sequences/standstill.hpp"

#include <cmath>

namespace rvbench::sequences {
namespace {

constexpr double tick_s = 0.01;
constexpr double feed_period_s = 0.1;
constexpr double stop_again_s = 1.0;
constexpr double must_last_s = 0.3;

bool stands_still(const BenchDevices& devices, double limit_rpm) {
  const double measured_rpm = std::abs(devices.measured_speed_rpm(0.2));
  const hal::DriveStatus& drive = devices.values().drive;
  const bool drive_knows = devices.drive_is_fresh() && std::isfinite(drive.speed_rpm);
  const bool drive_stopped = std::abs(drive.speed_rpm) <= limit_rpm;
  if (std::isfinite(measured_rpm)) {
    return measured_rpm <= limit_rpm && (!drive_knows || !drive.running || drive_stopped);
  }
  return drive_knows && drive_stopped;
}

}  // namespace

bool wait_for_standstill(hal::Rig& rig, BenchDevices& devices, const Teardown& teardown,
                         double brake_torque_Nm) {
  const double start_s = rig.clock->now_s();
  double moving_s = start_s;
  double next_feed_s = start_s;
  double next_stop_s = start_s + stop_again_s;
  for (double now_s = start_s; now_s < start_s + teardown.standstill_timeout_s;) {
    rig.clock->wait_until(now_s + tick_s);
    now_s = rig.clock->now_s();
    devices.read();
    if (!stands_still(devices, teardown.standstill_rpm)) moving_s = now_s;
    if (now_s - moving_s >= must_last_s) return true;
    if (now_s >= next_stop_s) {
      rig.drive->stop();
      next_stop_s = now_s + stop_again_s;
    }
    if (now_s >= next_feed_s) {
      devices.hold_brake(brake_torque_Nm);
      next_feed_s = now_s + feed_period_s;
    }
  }
  return false;
}

}  // namespace rvbench::sequences
