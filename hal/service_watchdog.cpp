#include "hal/service_watchdog.hpp"

#include <systemd/sd-daemon.h>

#include <cstdint>

namespace rvbench::hal {

ServiceWatchdog::ServiceWatchdog() {
  std::uint64_t allowed_us = 0;
  if (::sd_watchdog_enabled(0, &allowed_us) > 0) period_s_ = 1e-6 * double(allowed_us) / 4;
}

void ServiceWatchdog::feed(double now_s) noexcept {
  if (!is_on() || now_s < due_s_) return;
  due_s_ = now_s + period_s_;
  (void)::sd_notify(0, "WATCHDOG=1");
}

}  // namespace rvbench::hal
