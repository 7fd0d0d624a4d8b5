#pragma once

#include <cstdint>

#include "sim/inverter_device.hpp"
#include "sim/inverter_model.hpp"
#include "sim/modbus_server.hpp"
#include "sim/wire_fault.hpp"

namespace rvbench::sim {

/// A real Modbus TCP server in front of an InverterModel: the rvbench generic inverter, with its
/// own reading of the register table. Listens on 127.0.0.1.
///
/// Time     requests are served in real time, at the model's virtual time as it stands
/// Threads  serves in a thread of its own from construction to destruction
class InverterServer {
 public:
  /// @param model  must outlive the server
  /// @param port   0: the kernel chooses one
  /// @throws std::runtime_error if no socket can be had
  explicit InverterServer(InverterModel& model, std::uint8_t unit_id = 1, std::uint16_t port = 0)
      : device_(model), server_(device_, unit_id, port) {}

  std::uint16_t port() const { return server_.port(); }

  /// From now on the server misbehaves as planned; a plan with WireFault::none heals it.
  void inject(const WireFaultPlan& plan) { server_.inject(plan); }
  /// Of WireFault::late, real time; 0.4 s at first.
  void set_lateness_s(double lateness_s) { server_.set_lateness_s(lateness_s); }

  int requests() const { return server_.requests(); }  ///< valid ones, also those answered badly
  /// Requests and connections that met a planned fault.
  int misbehaved() const { return server_.misbehaved(); }

 private:
  InverterDevice device_;
  ModbusServer server_;
};

}  // namespace rvbench::sim
