#pragma once

#include <array>
#include <string>

#include "hal/rig.hpp"
#include "sequences/angle_track.hpp"
#include "sequences/device_watch.hpp"
#include "sequences/fresh_values.hpp"

namespace rvbench::sequences {

/// The devices that never make anybody wait: brake, safety inputs, torque transducer,
/// accelerometers. The drive, whose answers take their time, is BenchDevices' own.
///
/// A block of samples that does not go on in time is no answer: the device is frozen. One whose
/// samples are all lost is none either, but is handed on: it has its place in a record.
///
/// Threads  one caller at a time: the supervisor
class FieldDevices {
 public:
  explicit FieldDevices(hal::Rig& rig) : rig_(rig) {}

  void start();               ///< from now on everything must be seen
  bool all_answered() const;  ///< since start()
  FreshValues read();
  void hold_brake(double torque_Nm);

  /// What has not been seen for longer than that, in words; empty if all are well.
  std::string lost(double stale_after_s) const;

 private:
  void read_safety(FreshValues& fresh);
  void read_torque(FreshValues& fresh);
  void read_accelerations(FreshValues& fresh);
  void take_torque(hal::TorqueBlock block, FreshValues& fresh);
  void take_accelerations(hal::AccelerationBlock block, FreshValues& fresh);

  hal::Rig& rig_;
  DeviceWatch brake_{"brake", 0.05};
  DeviceWatch brake_command_{"brake (torque command)"};
  DeviceWatch safety_{"safety inputs"};
  DeviceWatch torque_{"torque sensor"};
  DeviceWatch accelerations_{"accelerometers"};
  double started_s_ = 0;
  AngleTrack angles_;
  double torque_end_s_ = -1;
  double accelerations_end_s_ = -1;
  bool temperature_was_known_ = false;

  static constexpr std::array watches{&FieldDevices::brake_, &FieldDevices::brake_command_,
                                      &FieldDevices::safety_, &FieldDevices::torque_,
                                      &FieldDevices::accelerations_};
};

}  // namespace rvbench::sequences
