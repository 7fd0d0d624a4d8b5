#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hal/clock.hpp"
#include "hal/drive.hpp"
#include "hal/inheriting_mutex.hpp"
#include "hal/modbus/drive_profile.hpp"
#include "hal/modbus/drive_words.hpp"
#include "hal/modbus/modbus_link.hpp"

namespace rvbench::hal {

struct ModbusInverterOptions {
  DriveProfile profile = {};
  ModbusPath path = {};
  std::uint8_t unit_id = 1;
  double response_timeout_s = 0.1;  ///< on the rig's clock; with stall_s from 0.001 to 10
  double stall_s = 0;               ///< real time granted on top, where the rig's clock is virtual:
                                    ///< a busy computer is no dead drive
  DriveLimits limits{.max_speed_rpm = 3000};
  /// Its pole pairs must agree with the drive's own setting, where it tells it.
  MotorPlate motor = {};
};

/// Drive over Modbus TCP or RTU, of any family that has a profile (hal/modbus/drives/).
///
/// Link     after a time-out or a garbled reply the connection is closed. The next request goes
///          over a new one, after the drive was identified again: so a late reply is never taken
///          for the next one
/// Start    a drive that wants several words to start gets one with each set_speed(), as the state
///          last read asks for
/// Retries  a failed read() is sent once more, counted; a setpoint never; a stop() once more
/// Time     no call blocks longer than 4 response time-outs, stall_s included, connect() 7, for
///          each block of registers that the family needs; on a serial line 4 more. stop() from
///          another thread also waits for the request under way, which is then not repeated
/// Clock    real time passes while a reply is awaited; each time-out is charged to a virtual
///          clock, so that a simulated drive's own watchdog runs on. stop() charges nothing: it
///          may come from another thread
class ModbusInverter final : public Drive {
 public:
  /// @param clock  must outlive the drive
  /// @throws std::invalid_argument naming the option that is out of range
  ModbusInverter(ModbusInverterOptions options, Clock& clock);

  DriveLimits limits() const override { return options_.limits; }

  /// Also resets a trip left over from earlier; refused if the drive stays tripped, or obeys its
  /// panel.
  Status connect() override;
  Result<DriveWatchdog> read_watchdog() override;
  Status set_speed(double speed_rpm) override;
  Result<DriveStatus> read() override;
  void stop() noexcept override;
  int retries() const override { return retries_; }

 private:
  Status charged(const std::function<Status()>& call);
  Status attempt(const std::function<Status()>& request);
  Status attempt_twice(const std::function<Status()>& request);
  Status identify();
  Status read_words(const char* operation, const std::vector<DriveBlock>& blocks,
                    DriveWords& words);
  Status read_status(DriveStatus& status);
  Status write_words(const char* operation, const std::vector<DriveWrite>& words);
  Status command_speed(double speed_rpm);
  Status reset_trip();

  const ModbusInverterOptions options_;
  const std::vector<DriveBlock> status_blocks_;
  const std::vector<DriveWrite> stop_words_;  ///< ready: a stop must not ask for memory
  Clock& clock_;
  InheritingMutex mutex_;  ///< guards the link and what follows; stop() may be the more urgent
  ModbusLink link_;
  bool was_connected_ = false;                ///< connect() was called
  bool connected_ = false;                    ///< connect() has succeeded
  DriveState state_ = DriveState::not_ready;  ///< as last read
  double next_step_s_ = 0;                    ///< not before, on the rig's clock
  std::atomic<bool> stop_waits_ = false;
  std::atomic<int> retries_ = 0;
};

}  // namespace rvbench::hal
