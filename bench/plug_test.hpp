#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "hal/clock.hpp"
#include "hal/drive.hpp"

namespace rvbench::bench {

struct PlugTestOptions {
  double speed_rpm = 150;  ///< slow: the shaft turns free
  double patience_s = 60;  ///< for each thing that somebody has to do
  double silence_s = 4;    ///< nothing is asked after the link died: twice the slowest watchdog
};

/// How the commissioning test ended.
struct PlugTest {
  bool passed = false;
  std::string finding;  ///< "it stopped by itself, fault code 1"
};

/// Turns the motor slowly, waits until somebody has pulled the drive's cable, keeps silent, waits
/// until it is plugged in again and asks whether the drive has stopped by itself. The drive is told
/// to stop on every way out.
///
/// @param drive  connected, its watchdog on
/// @param tell   what the person at the bench is to do or see next
PlugTest pull_the_plug(hal::Drive& drive, hal::Clock& clock, const PlugTestOptions& options,
                       const std::function<void(const std::string&)>& tell,
                       const std::stop_token& stop);

}  // namespace rvbench::bench
