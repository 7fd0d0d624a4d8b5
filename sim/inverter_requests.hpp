#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <vector>

#include "sim/inverter_model.hpp"
#include "sim/wire_fault.hpp"

struct _modbus;            // libmodbus's modbus_t
struct _modbus_mapping_t;  // its modbus_mapping_t

namespace rvbench::sim {

/// Serves one Modbus request after another, of either transport, with the faults that were
/// planned. What holds the sockets or the line calls it from its serving thread.
class InverterRequests {
 public:
  /// @param model  must outlive it
  /// @throws std::runtime_error if there is no pipe to be had
  InverterRequests(InverterModel& model, std::uint8_t unit_id);
  ~InverterRequests();

  InverterRequests(const InverterRequests&) = delete;
  InverterRequests& operator=(const InverterRequests&) = delete;

  /// Receives a request on `line` and answers it.
  /// @return false if the line is to be closed
  bool serve(_modbus* context, int line);

  /// Becomes readable when serving is to end: to be polled beside the lines.
  int ending() const { return wake_[0]; }
  void end();

  WireFaultSwitch faults;
  std::atomic<double> lateness_s = 0.4;
  std::atomic<int> count = 0;  ///< of valid requests, also those answered badly

 private:
  bool linger();
  void keep_or_freeze(_modbus_mapping_t& mapping, bool is_frozen);

  InverterModel& model_;
  std::uint8_t unit_id_;
  std::array<int, 2> wake_{-1, -1};
  std::map<std::uint16_t, std::vector<std::uint16_t>> last_read_;  ///< in good health, by address
};

}  // namespace rvbench::sim
