#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "hal/rig.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::sequences {

/// The newest value of everything, however old.
struct BenchValues {
  hal::DriveStatus drive;
  hal::BrakeStatus brake;
  hal::SafetyStatus safety;
  double angle_s = not_known;    ///< time of angle_rad on the rig's clock
  double angle_rad = not_known;  ///< of the input shaft
  double torque_Nm = not_known;  ///< mean of the newest block, at the input
};

/// What came in at this very tick.
struct FreshValues {
  std::optional<hal::DriveStatus> drive;
  std::optional<hal::BrakeStatus> brake;
  std::optional<hal::SafetyStatus> safety;
  std::optional<hal::TorqueBlock> torque;
  std::optional<hal::AccelerationBlock> accelerations;
  double torque_rate_Hz = 0;
  double acceleration_rate_Hz = 0;
  double speed_rpm = not_known;  ///< by the angle, over the last tick
};

/// Asks every device of a rig at its own pace, and knows how old each answer is.
///
/// A block of samples that does not go on in time is no answer: the device is frozen. One whose
/// samples are all lost is none either, but is handed on: it has its place in a record. A device
/// that failed is asked again after 20, 40, 80 ... ms, so that waiting for it does not starve the
/// others.
class BenchDevices {
 public:
  explicit BenchDevices(hal::Rig& rig);

  void start();               ///< from now on everything must be seen
  bool all_answered() const;  ///< since start()
  void read();
  void write(double speed_rpm, double brake_torque_Nm);
  void hold_brake(double torque_Nm);       ///< the brake alone, while the drive is stopped
  void leave_drive_alone(double until_s);  ///< asks it nothing: each request feeds its watchdog
  void end_speed_commands();               ///< from now on none is missed

  const FreshValues& fresh() const { return fresh_; }
  const BenchValues& values() const { return values_; }

  /// What has not been seen for longer than that, in words; empty if all are well.
  std::string lost(double stale_after_s) const;

  /// Speed of the input shaft by its angle over the last `window_s`; NaN if that is not fresh.
  double measured_speed_rpm(double window_s) const;
  bool drive_is_fresh() const;

 private:
  struct Watch {
    std::string device;
    double period_s = 0;
    double seen_s = 0;
    double due_s = 0;
    int failures = 0;
    std::string error{};
  };
  struct AnglePoint {
    double time_s, angle_rad;
  };

  template <typename T>
  std::optional<T> ask(Watch& watch, const std::function<Result<T>()>& call);
  void read_safety();
  void take_torque(hal::TorqueBlock block);
  void take_accelerations(hal::AccelerationBlock block);

  hal::Rig& rig_;
  Watch drive_{"drive", 0.05};
  Watch drive_command_{"drive (speed command)"};
  Watch brake_{"brake", 0.05};
  Watch brake_command_{"brake (torque command)"};
  Watch safety_{"safety inputs"};
  Watch torque_{"torque sensor"};
  Watch accelerations_{"accelerometers"};
  double started_s_ = 0;
  FreshValues fresh_;
  BenchValues values_;
  std::deque<AnglePoint> angles_;
  double torque_end_s_ = -1;
  double accelerations_end_s_ = -1;
  bool temperature_was_known_ = false;

  static constexpr std::array watches{&BenchDevices::drive_,        &BenchDevices::drive_command_,
                                      &BenchDevices::brake_,        &BenchDevices::brake_command_,
                                      &BenchDevices::safety_,       &BenchDevices::torque_,
                                      &BenchDevices::accelerations_};
};

}  // namespace rvbench::sequences
