#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "sim/modbus_device.hpp"
#include "sim/wire_fault.hpp"

struct _modbus;  // libmodbus's modbus_t

namespace rvbench::sim {

/// Serves one Modbus request after another, of either transport, with the faults that were
/// planned. What holds the sockets or the line calls it from its serving thread.
class ModbusRequests {
 public:
  /// @param device  must outlive it
  /// @throws std::runtime_error if there is no pipe to be had
  ModbusRequests(ModbusDevice& device, std::uint8_t unit_id);
  ~ModbusRequests();

  ModbusRequests(const ModbusRequests&) = delete;
  ModbusRequests& operator=(const ModbusRequests&) = delete;

  /// Receives a request on `line` and answers it.
  /// @return false if the line is to be closed
  bool serve(_modbus* context, int line);

  /// Becomes readable when serving is to end: to be polled beside the lines.
  int ending() const { return wake_[0]; }
  void end();

  WireFaultSwitch faults;
  std::atomic<double> lateness_s = 0.4;
  std::atomic<bool> forgets = false;  ///< what comes while it is late
  std::atomic<int> count = 0;         ///< of valid requests, also those answered badly

 private:
  using Reading = std::pair<int, std::uint16_t>;  // function and address

  bool linger();
  ModbusAnswer answer_to(const ModbusRequest& request, WireFault fault);

  ModbusDevice& device_;
  std::uint8_t unit_id_;
  std::array<int, 2> wake_{-1, -1};
  std::map<Reading, std::vector<std::uint16_t>> last_read_;  ///< in good health
};

}  // namespace rvbench::sim
