#include "bench/drive_probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sequences/phases/connect.hpp"

namespace rvbench::bench {

DriveProbe probe_drive(hal::Drive& drive, int readings, const std::stop_token& stop) {
  using Clock = std::chrono::steady_clock;
  DriveProbe probe;
  const Status connected = drive.connect();
  if (!connected) {
    probe.failed = connected.error();
    return probe;
  }
  const auto watchdog = drive.read_watchdog();
  if (!watchdog) {
    probe.failed = watchdog.error();
    return probe;
  }
  probe.watchdog = watchdog.value();
  for (int i = 0; i < readings && !stop.stop_requested(); ++i) {
    const auto start = Clock::now();
    const auto status = drive.read();
    const double took_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (status) {
      probe.status = status.value();
      probe.cycles_s.push_back(took_s);
    } else {
      ++probe.lost;
    }
  }
  std::ranges::sort(probe.cycles_s);
  probe.retries = drive.retries();
  return probe;
}

double quantile_s(const DriveProbe& probe, double share) {
  if (probe.cycles_s.empty()) return not_known;
  const auto last = static_cast<double>(probe.cycles_s.size() - 1);
  return probe.cycles_s[static_cast<std::size_t>(std::ceil(share * last))];
}

double proposed_timeout_s(const DriveProbe& probe) {
  return std::max(0.02, 3 * quantile_s(probe, 1));
}

std::string refusal_to_arm(const DriveProbe& probe) {
  if (probe.failed) return "it does not answer as it should";
  if (probe.lost > 0) return fmt::format("{} readings were lost", probe.lost);
  if (!probe.status.remote) return "it obeys its panel";
  if (probe.status.tripped)
    return fmt::format("it has tripped, fault code {}", probe.status.fault_code);
  if (probe.watchdog.timeout_s == 0) return "its communication watchdog is off, or cannot be read";
  if (!probe.watchdog.stops_motor) return "its communication watchdog does not stop the motor";
  if (probe.watchdog.timeout_s > sequences::longest_watchdog_s) {
    return fmt::format("its communication watchdog waits {:g} s, at most {:g} s are allowed",
                       probe.watchdog.timeout_s, sequences::longest_watchdog_s);
  }
  return "";
}

}  // namespace rvbench::bench
