#pragma once

namespace rvbench::hal {

/// The rig's time. Nobody else asks for the time or sleeps.
///
/// Real rigs count seconds since the clock was made; simulated and replayed rigs step: their
/// time moves only inside wait_until(), as far as it was asked to.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual double now_s() const = 0;  ///< never goes back

  /// Returns at `time_s` or as soon after as can be; at once if that time has passed.
  virtual void wait_until(double time_s) = 0;

  /// True if time moves only in wait_until(): progress then tells simulated from real seconds.
  virtual bool is_virtual() const = 0;
};

}  // namespace rvbench::hal
