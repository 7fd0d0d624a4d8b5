#pragma once

#include <cstdint>

#include "sim/modbus_server.hpp"
#include "sim/remote_io_device.hpp"

namespace rvbench::sim {

/// The remote I/O coupler on Modbus TCP, unit 1.
class RemoteIoServer {
 public:
  /// @param port  0: the kernel chooses one
  /// @throws std::runtime_error if no socket can be had
  explicit RemoteIoServer(std::uint16_t port = 0) : server_(coupler_, 1, port) {}

  void show(const hal::SafetyStatus& status) { coupler_.show(status); }

  std::uint16_t port() const { return server_.port(); }
  void inject(const WireFaultPlan& plan) { server_.inject(plan); }
  int requests() const { return server_.requests(); }

 private:
  RemoteIoDevice coupler_;
  ModbusServer server_;
};

}  // namespace rvbench::sim
