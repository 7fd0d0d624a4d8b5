#pragma once

#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

struct DriveLimits {
  double max_speed_rpm = 0;
};

struct DriveStatus {
  double speed_rpm = not_known;  ///< as the drive measures or estimates it; never an echo
  double output_frequency_Hz = not_known;
  double current_A = not_known;
  bool running = false;
  bool tripped = false;
  bool remote = true;  ///< it obeys the wire; false: somebody took it over at its panel
  int fault_code = 0;  ///< the drive's own number; 0 = none
};

/// What the drive itself does when nobody talks to it any more.
struct DriveWatchdog {
  double timeout_s = 0;  ///< 0 = switched off
  bool stops_motor = false;
};

/// Speed-controlled drive of the reducer's input shaft: inverter and motor as one.
///
/// Order    connect() → { set_speed() | read() }* → stop(), any number of times
/// Time     no call blocks longer than the deadline given at construction
/// Threads  one caller at a time; only stop() may come from another thread
/// Faults   after a failed call the link is drained and identified anew before the next request;
///          setpoints are never replayed
class Drive {
 public:
  virtual ~Drive() = default;

  virtual DriveLimits limits() const = 0;

  /// Opens the link and checks that the right device answers. Commands zero speed.
  virtual Status connect() = 0;

  /// Reads the drive's communication-loss settings back: the caller decides whether to arm.
  virtual Result<DriveWatchdog> read_watchdog() = 0;

  /// Commands the input-shaft speed; the drive's own ramp applies. Call it cyclically: each write
  /// feeds the drive's watchdog.
  /// @param speed_rpm  signed; positive turns the sun clockwise seen from the motor
  /// @throws std::invalid_argument if |speed_rpm| exceeds limits(): the caller's bug, not I/O
  virtual Status set_speed(double speed_rpm) = 0;

  virtual Result<DriveStatus> read() = 0;

  /// Commands a ramp to standstill. Legal in every state, any number of times. If the link is
  /// dead it tries once, within the deadline: the drive's own watchdog does the rest.
  virtual void stop() noexcept = 0;

  /// Requests sent again after a failure, since construction: shown in the report.
  virtual int retries() const = 0;
};

}  // namespace rvbench::hal
