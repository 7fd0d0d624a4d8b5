#pragma once

#include <limits>

namespace rvbench::hal {

/// Tells systemd that a service lives, where the unit has WatchdogSec: one that stops telling is
/// killed, and its drive stops by its own watchdog. Without systemd it does nothing.
/// Source: sd_notify(3), sd_watchdog_enabled(3).
///
/// Threads  one caller at a time
class ServiceWatchdog {
 public:
  ServiceWatchdog();

  /// Call it often: it tells four times within the time that the unit allows, or never.
  void feed(double now_s) noexcept;
  bool is_on() const { return period_s_ < std::numeric_limits<double>::infinity(); }

 private:
  double period_s_ = std::numeric_limits<double>::infinity();
  double due_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace rvbench::hal
