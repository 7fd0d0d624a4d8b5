#pragma once

#include <cstdint>
#include <string>

#include "sim/inverter_device.hpp"
#include "sim/inverter_model.hpp"
#include "sim/modbus_line.hpp"
#include "sim/wire_fault.hpp"

namespace rvbench::sim {

/// The simulated inverter on a serial line, as ModbusLine is one.
///
/// Time     requests are served in real time, at the model's virtual time as it stands
/// Threads  serves in a thread of its own from construction to destruction
class InverterLine {
 public:
  /// @param model  must outlive the line
  /// @throws std::runtime_error if there is no pseudo-terminal to be had
  explicit InverterLine(InverterModel& model, std::uint8_t unit_id = 1)
      : device_(model), line_(device_, unit_id) {}

  const std::string& device() const { return line_.device(); }

  void inject(const WireFaultPlan& plan) { line_.inject(plan); }
  void set_lateness_s(double lateness_s) { line_.set_lateness_s(lateness_s); }
  int requests() const { return line_.requests(); }

 private:
  InverterDevice device_;
  ModbusLine line_;
};

}  // namespace rvbench::sim
