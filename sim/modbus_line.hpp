#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sim/modbus_device.hpp"
#include "sim/wire_fault.hpp"

namespace rvbench::sim {

/// A simulated device on a serial line: Modbus RTU behind a pseudo-terminal. A pseudo-terminal
/// keeps no baud rate: bytes are there at once.
///
/// Time     requests are served in real time
/// Threads  serves in a thread of its own from construction to destruction
class ModbusLine {
 public:
  /// @param device  must outlive the line
  /// @throws std::runtime_error if there is no pseudo-terminal to be had
  ModbusLine(ModbusDevice& device, std::uint8_t unit_id);
  ~ModbusLine();

  ModbusLine(const ModbusLine&) = delete;
  ModbusLine& operator=(const ModbusLine&) = delete;

  /// What a client opens: "/dev/pts/3".
  const std::string& device() const;

  /// As ModbusServer's; WireFault::dead answers nothing here, there is no connection to close.
  void inject(const WireFaultPlan& plan);
  void set_lateness_s(double lateness_s);
  /// A device may forget requests that come while it is late with its reply, or answer them, too.
  void set_forgets(bool forgets);
  int requests() const;
  int misbehaved() const;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace rvbench::sim
