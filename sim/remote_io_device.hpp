#pragma once

#include <mutex>

#include "hal/safety_inputs.hpp"
#include "sim/modbus_device.hpp"

namespace rvbench::sim {

/// A remote I/O coupler, to which safety chain and housing sensor of the simulated bench are wired.
/// As couplers with eight digital inputs and one Pt100 input are:
///
///     discrete inputs 0 to 7   0: emergency-stop chain closed; 1: guard closed; the others are
///                              not wired: 0
///     input register 0         housing temperature, 0.1 degC, two's complement; 850.0 degC while
///                              the sensor's wire is broken
///
/// Holding registers and coils it has none. A broken wire is a 0: the chain reads as open.
class RemoteIoDevice final : public ModbusDevice {
 public:
  /// What is wired to it now; before the first time everything is open. From any thread.
  void show(const hal::SafetyStatus& status);
  ModbusAnswer carry_out(const ModbusRequest& request) override;

 private:
  std::mutex mutex_;
  hal::SafetyStatus status_;
};

}  // namespace rvbench::sim
