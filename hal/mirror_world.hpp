#pragma once

#include <limits>
#include <map>
#include <vector>

#include "hal/clock.hpp"
#include "hal/drive.hpp"
#include "hal/rig.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::hal {

/// What can go wrong on a mirror rig. A dead device lets each call run into its deadline; a frozen
/// one repeats its last answer.
enum class MirrorFault {
  drive_dead,
  drive_frozen,
  drive_tripped,
  drive_throws,  ///< a defect of the driver: read() throws
  brake_dead,
  brake_tripped,
  brake_slack,  ///< it answers, but holds nothing
  torque_sensor_dead,
  torque_sensor_frozen,
  accelerometers_dead,
  accelerometers_frozen,
  safety_dead,
  estop,
  guard_open,
  over_torque,       ///< 100 N·m at the input
  over_speed,        ///< ten times the real speed is measured
  over_temperature,  ///< 100 degC
  shock,             ///< 0.99 of the accelerometers' range
  clipped,           ///< samples at full scale
  scans_lost,        ///< every second scan is NaN
  uneven_speed       ///< the shaft runs ±20 %, at 0.3 Hz
};

struct MirrorOptions {
  double gear_ratio = 121;
  double max_speed_rpm = 3000;
  double max_brake_torque_Nm = 400;
  double ramp_rpm_s = 500;
  double slip_pct = 0;  ///< the shaft runs this much below the command
  DriveWatchdog watchdog{1.0, true};
  double torque_rate_Hz = 1000;
  double acceleration_rate_Hz = 4960;
  double acceleration_range_m_s2 = 490;
  double deadline_s = 0.02;  ///< how long a call to a dead device blocks
};

/// What the devices of a mirror rig share: a shaft that follows its command by a ramp, without
/// inertia, friction or vibration. Tests look behind the devices here.
class MirrorWorld final : public Backstage {
 public:
  MirrorWorld(const MirrorOptions& options, Clock& clock);

  /// From `from_s` until `until_s` of the rig's time.
  void schedule(MirrorFault fault, double from_s,
                double until_s = std::numeric_limits<double>::infinity());
  bool has(MirrorFault fault) const;

  void advance();  ///< to the clock's time
  void command_speed(double speed_rpm);
  void command_brake(double torque_Nm);
  std::vector<TorqueSample> take_samples();  ///< all since the last call

  const MirrorOptions& options() const { return options_; }
  Clock& clock() { return clock_; }
  double speed_rpm() const { return speed_rpm_; }  ///< true speed of the shaft
  double brake_torque_Nm() const;                  ///< true, at the output

  /// Speeds commanded so far with their times, 0 for stop().
  const std::vector<std::pair<double, double>>& speed_commands() const { return speed_commands_; }
  /// When the brake was last released; NaN if never since the last set_torque().
  double brake_released_s() const { return brake_released_s_; }
  void release_brake();

 private:
  struct Span {
    double from_s, until_s;
  };

  void step(double time_s);

  MirrorOptions options_;
  Clock& clock_;
  std::map<MirrorFault, Span> faults_;
  double time_s_ = 0;
  double target_rpm_ = 0;
  double commanded_s_ = 0;
  double speed_rpm_ = 0;
  double angle_rad_ = 0;
  double brake_Nm_ = 0;
  double brake_commanded_s_ = 0;
  double brake_released_s_ = not_known;
  long samples_made_ = 0;
  std::vector<TorqueSample> samples_;
  std::vector<std::pair<double, double>> speed_commands_;
};

}  // namespace rvbench::hal
