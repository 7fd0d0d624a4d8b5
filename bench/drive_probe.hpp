#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hal/drive.hpp"

namespace rvbench::bench {

/// What a drive answers to somebody who only asks.
struct DriveProbe {
  std::optional<IoError> failed;  ///< why it could not be asked at all; the rest is empty then
  hal::DriveStatus status;
  hal::DriveWatchdog watchdog;
  std::vector<double> cycles_s;  ///< how long its state took to read, each time, shortest first
  int lost = 0;                  ///< readings without an answer
  int retries = 0;
};

/// Connects, and reads the state `readings` times. The drive is told to stop, and nothing else.
DriveProbe probe_drive(hal::Drive& drive, int readings, const std::stop_token& stop);

/// The duration that a share of the readings did not exceed; not_known without any.
double quantile_s(const DriveProbe& probe, double share);

/// A time-out that a healthy drive would not meet and that a lost one does not stretch: three
/// times the longest reading, at least 20 ms; for one reading, not for each request of it.
double proposed_timeout_s(const DriveProbe& probe);

/// Why a run would refuse to arm: "its watchdog is off"; empty if nothing speaks against it.
std::string refusal_to_arm(const DriveProbe& probe);

}  // namespace rvbench::bench
