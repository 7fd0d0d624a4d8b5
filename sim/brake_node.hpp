#pragma once

#include <cstdint>

#include "hal/can_transport.hpp"
#include "sim/can_node_frames.hpp"

namespace rvbench::sim {

/// Load brake: obeys command frames 0x201, reports with status frames 0x281 at its rate.
///
/// Command  uint16 torque in 0.1 N·m, uint8 enable, uint8 rolling counter
/// Status   uint16 torque in 0.1 N·m, uint8 state (1 engaged, 2 tripped, 4 command lost),
///          uint8 rolling counter; least significant byte first
/// Safety   releases by itself when fresh commands stop coming for comm_loss_timeout_s while
///          engaged; it then obeys again only after a command with enable = 0
class BrakeNode {
 public:
  /// Assumed, of the class of brake that the article's loads ask for: 150 % of 167 N·m.
  struct Parameters {
    double status_rate_Hz = 100;
    double comm_loss_timeout_s = 1.0;
    double max_torque_Nm = 600;  ///< setpoints above are cut to it
  };

  /// @param bus  must outlive the node; it is the only one that receives from this end
  /// @throws std::invalid_argument if a parameter is not finite and positive
  BrakeNode(hal::CanTransport& bus, const Parameters& parameters);

  /// Takes the commands that have come, watches the time-out, sends the status frames due.
  /// @param measured_Nm  torque that the brake measures at its shaft now
  void advance_to(double time_s, double measured_Nm);

  double setpoint_Nm() const { return engaged_ ? setpoint_Nm_ : 0; }  ///< what the plant applies
  bool engaged() const { return engaged_; }
  void trip();                                         ///< releases until a command with enable = 0
  void set_fault(NodeFault fault) { fault_ = fault; }  ///< silent: it does not listen either

 private:
  void take_command(const hal::CanFrame& frame);
  void send_status(double measured_Nm);

  hal::CanTransport& bus_;
  Parameters parameters_;
  NodeFault fault_ = NodeFault::none;
  bool engaged_ = false;
  bool tripped_ = false;
  bool command_lost_ = false;
  double setpoint_Nm_ = 0;
  int last_counter_ = -1;  ///< of the last command; -1 before the first
  double time_s_ = 0;
  double last_command_s_ = 0;
  std::int64_t statuses_ = 0;  ///< sent or due so far
  hal::CanFrame last_frame_;
};

}  // namespace rvbench::sim
