#pragma once

#include <cstdint>
#include <memory>

#include "sim/inverter_model.hpp"
#include "sim/wire_fault.hpp"

namespace rvbench::sim {

/// A real Modbus TCP server in front of an InverterModel: the rvbench generic inverter, with its
/// own reading of the register table. Listens on 127.0.0.1, on a port that the kernel chooses.
///
/// Time     requests are served in real time, at the model's virtual time as it stands
/// Threads  serves in a thread of its own from construction to destruction
class InverterServer {
 public:
  /// @param model  must outlive the server
  /// @throws std::runtime_error if no socket can be had
  explicit InverterServer(InverterModel& model, std::uint8_t unit_id = 1);
  ~InverterServer();

  InverterServer(const InverterServer&) = delete;
  InverterServer& operator=(const InverterServer&) = delete;

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
