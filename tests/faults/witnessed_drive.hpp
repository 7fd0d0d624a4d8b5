#pragma once

#include <memory>
#include <utility>

#include "hal/clock.hpp"
#include "hal/drive.hpp"
#include "sim/inverter_server.hpp"

namespace rvbench::test {

struct Witness {
  bool held_up = false;             ///< by the computer
  int belated_readings = 0;         ///< a late reply was taken for the next one
  double stop_asked_s = not_known;  ///< the first request since one for a speed other than 0
};

/// Stands between the controller and the driver, with an eye on the wall clock: requests are
/// answered in real time, and a busy computer may take longer than the link waits.
///
/// A call that took as long as a time-out although neither it nor the call before it met a planned
/// fault was held up by the computer: nothing follows from the run. A status must be what the drive
/// shows while it is asked: virtual time stands still until there is an answer.
class WitnessedDrive final : public hal::Drive {
 public:
  /// @param model, server, clock, witness  must outlive it
  WitnessedDrive(std::unique_ptr<hal::Drive> drive, const sim::InverterModel& model,
                 const sim::InverterServer& server, const hal::Clock& clock, double patience_s,
                 Witness& witness)
      : drive_(std::move(drive)),
        model_(model),
        server_(server),
        clock_(clock),
        patience_s_(patience_s),
        witness_(witness) {}

  void replace_driver(std::unique_ptr<hal::Drive> drive) { drive_ = std::move(drive); }

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
  const sim::InverterModel& model_;
  const sim::InverterServer& server_;
  const hal::Clock& clock_;
  double patience_s_;
  Witness& witness_;
  int misbehaved_ = 0;          ///< when the call before began
  bool asked_to_turn_ = false;  ///< and not to stop since
};

}  // namespace rvbench::test
