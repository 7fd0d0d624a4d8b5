#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hal/types/result.hpp"

namespace rvbench::hal {

/// One Modbus TCP connection as a client, over libmodbus.
///
/// A failed exchange closes the connection, unless the device answered with an exception: then
/// request and reply are still in step. libmodbus alone hands a reply that comes after the
/// time-out to the request that follows; a reply to a closed socket goes nowhere.
///
/// Threads  one caller at a time
class ModbusLink {
 public:
  /// @throws std::invalid_argument if host is not an IPv4 address, port is 0, or the time-out is
  ///         not within 0.001 to 10 s
  ModbusLink(std::string host, std::uint16_t port, std::uint8_t unit_id, double timeout_s);
  ~ModbusLink();

  ModbusLink(const ModbusLink&) = delete;
  ModbusLink& operator=(const ModbusLink&) = delete;

  bool is_open() const { return connection_ != nullptr; }
  Status open();
  void close();

  /// Reads words.size() holding registers from the PDU address on (function 3).
  Status read(const char* operation, std::uint16_t address, std::span<std::uint16_t> words);
  /// Writes them (function 16).
  Status write(const char* operation, std::uint16_t address, std::span<const std::uint16_t> words);

  int timeouts() const { return timeouts_; }  ///< seen since construction
  IoError failure(IoErrc code, const std::string& operation) const;

 private:
  struct Connection;
  Status settle(int words_done, std::size_t words_asked, const char* operation,
                std::uint16_t address);

  std::string host_;
  std::uint16_t port_;
  std::uint8_t unit_id_;
  double timeout_s_;
  std::unique_ptr<Connection> connection_;
  int timeouts_ = 0;
};

}  // namespace rvbench::hal
