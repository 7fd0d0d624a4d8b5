#pragma once

#include <limits>
#include <string>

namespace rvbench::hal {

/// Tells systemd that a service lives, where the unit has WatchdogSec: one that stops telling is
/// killed, and its drive stops by its own watchdog. Without systemd it does nothing.
///
/// By a datagram of its own that is never waited for: sd_notify() waits while systemd's queue is
/// full, and who tells is the supervisor, whose rounds must not wait. What the queue does not take
/// is told in the next round.
/// Source: sd_notify(3), sd_watchdog_enabled(3).
///
/// Threads  one caller at a time
class ServiceWatchdog {
 public:
  ServiceWatchdog();
  ~ServiceWatchdog();
  ServiceWatchdog(const ServiceWatchdog&) = delete;
  ServiceWatchdog& operator=(const ServiceWatchdog&) = delete;

  /// Call it often: it tells four times within the time that the unit allows, or never.
  void feed(double now_s) noexcept;
  bool is_on() const { return socket_ >= 0; }

 private:
  int socket_ = -1;
  std::string address_;  ///< a sockaddr_un, as long as the name is
  double period_s_ = std::numeric_limits<double>::infinity();
  double due_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace rvbench::hal
