#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "hal/clock.hpp"
#include "hal/drive.hpp"
#include "hal/modbus/inverter_registers.hpp"
#include "hal/modbus/modbus_link.hpp"

namespace rvbench::hal {

struct ModbusInverterOptions {
  std::string host = "127.0.0.1";  ///< IPv4 address
  std::uint16_t port = 502;
  std::uint8_t unit_id = 1;
  double response_timeout_s = 0.1;  ///< on the rig's clock; with stall_s from 0.001 to 10
  double stall_s = 0;               ///< real time granted on top, where the rig's clock is virtual:
                                    ///< a busy computer is no dead drive
  DriveLimits limits{.max_speed_rpm = 3000};
  int pole_pairs = 2;  ///< of the motor; must agree with the drive's own setting
};

/// Drive over Modbus TCP: the rvbench generic inverter (hal/modbus/inverter_registers.hpp).
///
/// Link     after a time-out or a garbled reply the connection is closed. The next request goes
///          over a new one, after the drive was identified again: so a late reply is never taken
///          for the next one
/// Retries  a failed read() is sent once more, counted; a setpoint never; a stop() once more
/// Time     no call blocks longer than 4 response time-outs, stall_s included, connect() 7;
///          stop() from another thread also waits for the request under way, which is then not
///          repeated
/// Clock    real time passes while a reply is awaited; each time-out is charged to a virtual
///          clock, so that a simulated drive's own watchdog runs on. stop() charges nothing: it
///          may come from another thread
class ModbusInverter final : public Drive {
 public:
  /// @param clock  must outlive the drive
  /// @throws std::invalid_argument naming the option that is out of range
  ModbusInverter(ModbusInverterOptions options, Clock& clock);

  DriveLimits limits() const override { return options_.limits; }

  /// Also resets a trip left over from earlier; refused if the drive stays tripped.
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
  Status identify(inverter_registers::Settings& settings);
  Status read_status(DriveStatus& status);
  Status write_command(const char* operation, const inverter_registers::CommandWords& words);
  Status reset_trip();

  const ModbusInverterOptions options_;
  Clock& clock_;
  std::mutex mutex_;  ///< guards the link and the flags below
  ModbusLink link_;
  bool was_connected_ = false;  ///< connect() was called
  bool connected_ = false;      ///< connect() has succeeded
  std::atomic<bool> stop_waits_ = false;
  std::atomic<int> retries_ = 0;
};

}  // namespace rvbench::hal
