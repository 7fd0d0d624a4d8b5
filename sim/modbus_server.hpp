#pragma once

#include <cstdint>
#include <memory>

#include "sim/modbus_device.hpp"
#include "sim/wire_fault.hpp"

namespace rvbench::sim {

/// A real Modbus TCP server in front of a simulated device, on 127.0.0.1.
///
/// Time     requests are served in real time
/// Threads  serves in a thread of its own from construction to destruction
class ModbusServer {
 public:
  /// @param device  must outlive the server
  /// @param port    0: the kernel chooses one
  /// @throws std::runtime_error if no socket can be had
  ModbusServer(ModbusDevice& device, std::uint8_t unit_id, std::uint16_t port = 0);
  ~ModbusServer();

  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  std::uint16_t port() const;

  /// From now on the server misbehaves as planned; a plan with WireFault::none heals it.
  void inject(const WireFaultPlan& plan);
  void set_lateness_s(double lateness_s);  ///< of WireFault::late, real time; 0.4 s at first

  int requests() const;    ///< valid requests seen, also those answered badly
  int misbehaved() const;  ///< requests and connections that met a planned fault

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace rvbench::sim
