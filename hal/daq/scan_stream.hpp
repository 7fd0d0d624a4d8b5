#pragma once

#include <deque>
#include <mutex>
#include <optional>

#include "hal/accelerometers.hpp"
#include "hal/daq/sample_clock.hpp"

namespace rvbench::hal {

/// Scans on their way from the thread that waits for a device to the one that may not wait.
///
/// Threads  push() and fail() from the device's thread, take() from another
class ScanStream {
 public:
  /// @param most_scans  that wait for take(); more are an overrun
  ScanStream(double rate_Hz, Eigen::Index most_scans);

  void push(AccelerationBlock::Scans scans, double arrival_s);
  void fail(const IoError& error);  ///< the first one counts; nothing is pushed any more

  struct Taken {
    AccelerationBlock::Scans scans;
    double t0_s = 0;  ///< of the first scan on the rig's clock
  };

  /// What has come since the last call, or why nothing comes any more. The error is told once all
  /// scans before it are taken.
  Result<Taken> take();

  double uncertainty_s() const;  ///< of t0_s; NaN until it is known

 private:
  double slewed_t0_s(Eigen::Index scans);

  const Eigen::Index most_scans_;
  mutable std::mutex mutex_;
  std::deque<AccelerationBlock::Scans> waiting_;
  Eigen::Index waiting_scans_ = 0;
  std::int64_t pushed_ = 0, taken_ = 0;
  SampleClock clock_;
  double next_t0_s_ = not_known;
  std::optional<IoError> failure_;
};

}  // namespace rvbench::hal
