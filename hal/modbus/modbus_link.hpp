#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hal/modbus/modbus_path.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

struct ModbusLinkOptions {
  ModbusPath path = {};
  std::string device = "inverter";  ///< as errors name it
  std::uint8_t unit_id = 1;
  double timeout_s = 0.1;               ///< until a reply is complete; 0.001 to 10
  double turnaround_s = 0;              ///< silence kept between a reply and the next request
  std::vector<std::uint16_t> writable;  ///< all registers that may be written
};

/// One Modbus connection as a client, over libmodbus.
///
/// Late     libmodbus alone hands a reply that comes after the time-out to the request that
///          follows. So a failed exchange closes the connection, unless the device answered with
///          an exception: then request and reply are still in step. On TCP a reply to a closed
///          socket goes nowhere; on a serial line open() drops what still comes in, until there
///          was silence for a time-out
/// Threads  one caller at a time
class ModbusLink {
 public:
  /// @throws std::invalid_argument if the host is not an IPv4 address, the port 0, the device
  ///         empty, the line's settings unknown to serial lines, or the time-out out of range
  explicit ModbusLink(ModbusLinkOptions options);
  ~ModbusLink();

  ModbusLink(const ModbusLink&) = delete;
  ModbusLink& operator=(const ModbusLink&) = delete;

  bool is_open() const { return connection_ != nullptr; }
  Status open();
  void close();

  /// Reads words.size() holding registers from the PDU address on (function 3).
  Status read(const char* operation, std::uint16_t address, std::span<std::uint16_t> words);
  /// Reads words.size() input registers (function 4).
  Status read_inputs(const char* operation, std::uint16_t address, std::span<std::uint16_t> words);
  /// Reads bits.size() discrete inputs (function 2), each as 0 or 1.
  Status read_bits(const char* operation, std::uint16_t address, std::span<std::uint8_t> bits);
  /// Writes neighbouring registers (function 16).
  /// @throws std::invalid_argument if one of them is not writable; nothing is sent
  Status write(const char* operation, std::uint16_t address, std::span<const std::uint16_t> words);
  /// Writes one register (function 6). @throws as write()
  Status write_one(const char* operation, std::uint16_t address, std::uint16_t word);

  int timeouts() const { return timeouts_; }            ///< seen since construction
  int dropped_bytes() const { return dropped_bytes_; }  ///< late ones on a serial line
  IoError failure(IoErrc code, const std::string& operation) const;

 private:
  struct Connection;
  void keep_turnaround() const;
  void require_writable(std::uint16_t address, std::size_t count) const;
  Status settle(int words_done, std::size_t words_asked, const char* operation,
                std::uint16_t address);
  void drop_late_bytes();

  const ModbusLinkOptions options_;
  std::unique_ptr<Connection> connection_;
  bool may_be_late_ = false;  ///< a reply of the last connection
  int timeouts_ = 0;
  int dropped_bytes_ = 0;
  std::chrono::steady_clock::time_point quiet_since_;
};

}  // namespace rvbench::hal
