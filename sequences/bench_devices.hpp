#pragma once

#include <string>

#include "hal/rig.hpp"
#include "sequences/angle_track.hpp"
#include "sequences/fresh_values.hpp"
#include "sequences/supervisor.hpp"

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

/// The bench as the sequencer sees it: asks the drive at its own pace, and has the other devices
/// from the supervisor, who learns here what the drive says.
class BenchDevices {
 public:
  BenchDevices(hal::Rig& rig, Supervisor& supervisor) : rig_(rig), supervisor_(supervisor) {}

  void start();               ///< from now on everything must be seen
  bool all_answered() const;  ///< since start()
  void read();
  /// Nothing once the supervisor has tripped.
  void write(double speed_rpm, double brake_torque_Nm);
  void hold_brake(double torque_Nm);       ///< the brake alone, while the drive is stopped
  void stop_drive() noexcept;              ///< unless the supervisor is just doing it
  void leave_drive_alone(double until_s);  ///< asks it nothing: each request feeds its watchdog
  void end_speed_commands();               ///< from now on none is missed

  const FreshValues& fresh() const { return taken_.fresh; }
  const BenchValues& values() const { return values_; }

  /// What had been silent for longer than the plan allows when read() was called last, in words;
  /// empty if all are well.
  const std::string& lost() const { return taken_.lost; }

  /// Speed of the input shaft by its angle over the last `window_s`; NaN if that is not fresh.
  double measured_speed_rpm(double window_s) const;
  bool drive_is_fresh() const;
  bool drive_fell_silent() const;  ///< to either kind of request, since start()

  /// By the angle, or by the drive where the angle is lost; by both where both tell. An angle that
  /// has stood still since the drive last told that it turned the shaft is not believed alone.
  bool stands_still(double limit_rpm) const;

 private:
  void stop_after_supervisor() noexcept;
  bool was_contradicted(double limit_rpm) const;

  hal::Rig& rig_;
  Supervisor& supervisor_;
  DriveReport drive_;
  double started_s_ = 0;
  Handover taken_;
  BenchValues values_;
  AngleTrack angles_;
  double fastest_since_heard_rpm_ = not_known;  ///< by the angle, since the drive last told its own
};

}  // namespace rvbench::sequences
