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
///          socket goes nowhere. On a serial line nothing says which request a reply is to: open()
///          drops what still comes in, until there was silence for two time-outs, and what comes
///          later yet is_in_doubt() and confirm_in_step() are for
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

  /// True if the next answer may be one to a request before open().
  bool is_in_doubt() const { return is_in_doubt_; }
  /// To be called after one exchange of which nothing is kept. Where that took an older answer for
  /// its own, its own is yet to come: waits a time-out for it, and closes the link if it does. At
  /// once if there is no doubt.
  Status confirm_in_step();

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
  bool drop_bytes(std::chrono::steady_clock::time_point end);

  const ModbusLinkOptions options_;
  std::unique_ptr<Connection> connection_;
  bool may_be_late_ = false;  ///< a reply of the last connection
  bool is_in_doubt_ = false;
  int timeouts_ = 0;
  int dropped_bytes_ = 0;
  std::chrono::steady_clock::time_point quiet_since_;
};

}  // namespace rvbench::hal
