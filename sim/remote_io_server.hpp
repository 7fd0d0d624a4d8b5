#pragma once

#include <cstdint>
#include <mutex>

#include "hal/safety_inputs.hpp"
#include "sim/modbus_device.hpp"
#include "sim/modbus_server.hpp"

namespace rvbench::sim {

/// A remote I/O coupler on Modbus TCP, to which safety chain and housing sensor of the simulated
/// bench are wired. As couplers with eight digital inputs and one Pt100 input are:
///
///     discrete inputs 0 to 7   0: emergency-stop chain closed; 1: guard closed; the others are
///                              not wired: 0
///     input register 0         housing temperature, 0.1 degC, two's complement; 850.0 degC while
///                              the sensor's wire is broken
///
/// Holding registers and coils it has none. A broken wire is a 0: the chain reads as open.
class RemoteIoServer {
 public:
  /// @param port  0: the kernel chooses one
  /// @throws std::runtime_error if no socket can be had
  explicit RemoteIoServer(std::uint16_t port = 0);

  /// What is wired to it now; before the first time everything is open. From any thread.
  void show(const hal::SafetyStatus& status);

  std::uint16_t port() const { return server_.port(); }
  void inject(const WireFaultPlan& plan) { server_.inject(plan); }
  int requests() const { return server_.requests(); }

 private:
  class Coupler final : public ModbusDevice {
   public:
    void show(const hal::SafetyStatus& status);
    ModbusAnswer carry_out(const ModbusRequest& request) override;

   private:
    std::mutex mutex_;
    hal::SafetyStatus status_;
  };

  Coupler coupler_;
  ModbusServer server_;
};

}  // namespace rvbench::sim
