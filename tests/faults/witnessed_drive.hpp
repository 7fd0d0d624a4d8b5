#pragma once

#include <memory>

#include "hal/drive.hpp"
#include "sim/inverter_server.hpp"

namespace rvbench::test {

/// Stands between the controller and the driver, with an eye on the wall clock: requests are
/// answered in real time, and a busy computer may take longer than the link waits.
///
/// A call that took as long as a time-out although neither it nor the call before it met a planned
/// fault was held up by the computer: nothing follows from the run.
class WitnessedDrive final : public hal::Drive {
 public:
  /// @param server, was_held_up  must outlive it
  WitnessedDrive(std::unique_ptr<hal::Drive> drive, const sim::InverterServer& server,
                 double patience_s, bool& was_held_up)
      : drive_(std::move(drive)),
        server_(server),
        patience_s_(patience_s),
        was_held_up_(was_held_up) {}

  hal::DriveLimits limits() const override { return drive_->limits(); }
  Status connect() override;
  Result<hal::DriveWatchdog> read_watchdog() override;
  Status set_speed(double speed_rpm) override;
  Result<hal::DriveStatus> read() override;
  void stop() noexcept override;
  int retries() const override { return drive_->retries(); }

 private:
  class Call;

  std::unique_ptr<hal::Drive> drive_;
  const sim::InverterServer& server_;
  double patience_s_;
  bool& was_held_up_;
  int misbehaved_ = 0;  ///< when the call before began
};

}  // namespace rvbench::test
