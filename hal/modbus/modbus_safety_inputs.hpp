#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>

#include "hal/clock.hpp"
#include "hal/device_thread.hpp"
#include "hal/modbus/modbus_link.hpp"
#include "hal/modbus/modbus_path.hpp"
#include "hal/safety_inputs.hpp"

namespace rvbench::hal {

/// A contact of the safety chain on a discrete input, by its PDU address. Closed means safe: wired
/// so that it reads 1 then, a broken wire reads as an open chain.
struct SafetyContact {
  std::uint16_t address = 0;
  bool closed = true;  ///< what the input reads while the contact is closed
};

/// The register of the housing temperature, by its PDU address.
struct TemperatureRegister {
  std::uint16_t address = 0;
  bool is_holding = false;  ///< a holding register (function 3); else an input register (4)
  bool is_signed = true;
  double scale_degC = 0.1;  ///< per count
  double offset_degC = 0;   ///< at a count of 0
  double min_degC = -40;    ///< below and above it is not known: an input
  double max_degC = 200;    ///< shows the end of its range while the sensor's wire is broken
};

struct ModbusSafetyOptions {
  ModbusPath path = {};
  std::uint8_t unit_id = 1;
  SafetyContact estop{.address = 0};
  SafetyContact guard{.address = 1};
  TemperatureRegister temperature = {};
  double response_timeout_s = 0.1;
  double period_s = 0.01;   ///< from one question to the next; a slow line makes it longer
  double deadline_s = 0.2;  ///< how old the newest answer may be
};

/// Safety chain and housing sensor on a remote I/O coupler, over Modbus TCP or RTU.
///
/// Polling  a thread of its own asks, from connect() on: read() hands out the newest answer and
///          never waits, neither for a coupler that is silent nor for that thread. Both contacts
///          are read in one request
/// Link     as ModbusLink says: after a time-out or a garbled reply over a new connection. On a
///          serial line it takes four response time-outs from a lost answer to the next one that is
///          believed: with a shorter deadline one lost answer is a lost device
/// Age      an answer is as old as its question
/// Leaves out  a coupler whose own bus is dead and that answers with what it last knew: set its
///          substitute values to 0
/// Errors   timeout: no answer within the deadline, and the last failure of the link with it;
///          disconnected: before connect(), or something was thrown in that thread
/// Time     connect() waits for one answer, twice the response time-out at most; on a serial line
///          that it had open before, six time-outs more
class ModbusSafetyInputs final : public SafetyInputs {
 public:
  /// @param clock  must outlive the inputs; its now_s() is asked from a thread of their own
  /// @throws std::invalid_argument naming the option that is out of range
  ModbusSafetyInputs(const ModbusSafetyOptions& options, const Clock& clock);
  ~ModbusSafetyInputs() override;

  ModbusSafetyInputs(const ModbusSafetyInputs&) = delete;
  ModbusSafetyInputs& operator=(const ModbusSafetyInputs&) = delete;

  Status connect() override;
  Result<SafetyStatus> read() override;

 private:
  /// What is known.
  struct Known {
    std::optional<SafetyStatus> status;  ///< the newest answer
    std::optional<IoError> failure;      ///< of the link, since then
  };

  Result<SafetyStatus> ask();
  Status open();
  Result<SafetyStatus> ask_once();
  void ask_and_note();
  void poll(const std::stop_token& stop);

  const ModbusSafetyOptions options_;
  const Clock& clock_;
  ModbusLink link_;  ///< of whoever polls
  Known polled_;     ///< likewise
  Known read_;       ///< of whoever reads

  std::mutex mutex_;  ///< guards what follows
  Known told_;
  std::condition_variable_any ending_;

  DeviceThread poller_;
};

}  // namespace rvbench::hal
