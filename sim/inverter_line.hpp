#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sim/inverter_model.hpp"
#include "sim/wire_fault.hpp"

namespace rvbench::sim {

/// The simulated inverter on a serial line: Modbus RTU behind a pseudo-terminal. A pseudo-terminal
/// keeps no baud rate: bytes are there at once.
///
/// Time     requests are served in real time, at the model's virtual time as it stands
/// Threads  serves in a thread of its own from construction to destruction
class InverterLine {
 public:
  /// @param model  must outlive the line
  /// @throws std::runtime_error if there is no pseudo-terminal to be had
  explicit InverterLine(InverterModel& model, std::uint8_t unit_id = 1);
  ~InverterLine();

  InverterLine(const InverterLine&) = delete;
  InverterLine& operator=(const InverterLine&) = delete;

  /// What a client opens: "/dev/pts/3".
  const std::string& device() const;

  /// As InverterServer's; WireFault::dead answers nothing here, there is no connection to close.
  void inject(const WireFaultPlan& plan);
  void set_lateness_s(double lateness_s);
  int requests() const;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace rvbench::sim
