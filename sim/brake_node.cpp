#include "sim/brake_node.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/require_positive.hpp"

namespace rvbench::sim {
namespace {

constexpr std::uint32_t brake_command_id = 0x201;
constexpr std::uint32_t brake_status_id = 0x281;

}  // namespace

BrakeNode::BrakeNode(hal::CanTransport& bus, const Parameters& parameters)
    : bus_(bus), parameters_(parameters) {
  require_positive(parameters.status_rate_Hz, "BrakeNode", "status_rate_Hz");
  require_positive(parameters.comm_loss_timeout_s, "BrakeNode", "comm_loss_timeout_s");
  require_positive(parameters.max_torque_Nm, "BrakeNode", "max_torque_Nm");
}

void BrakeNode::advance_to(double time_s, double measured_Nm) {
  time_s_ = time_s;
  while (const auto frame = bus_.receive()) {
    if (fault_ != NodeFault::silent) take_command(frame.value());
  }
  if (engaged_ && time_s_ - last_command_s_ > parameters_.comm_loss_timeout_s) {
    engaged_ = false;
    command_lost_ = true;
  }
  while (static_cast<double>(statuses_) / parameters_.status_rate_Hz <= time_s) {
    send_status(measured_Nm);
    ++statuses_;
  }
}

void BrakeNode::trip() {
  tripped_ = true;
  engaged_ = false;
}

void BrakeNode::take_command(const hal::CanFrame& frame) {
  const int counter = frame.data[3];
  if (frame.id != brake_command_id || frame.length != 4 || counter == last_counter_) return;
  last_counter_ = counter;
  last_command_s_ = time_s_;
  const bool enable = frame.data[2] == 1;
  if (!enable) {
    engaged_ = tripped_ = command_lost_ = false;
    return;
  }
  if (tripped_ || command_lost_) return;
  engaged_ = true;
  const double asked_Nm = 0.1 * (frame.data[0] + 256 * frame.data[1]);
  setpoint_Nm_ = std::min(asked_Nm, parameters_.max_torque_Nm);
}

void BrakeNode::send_status(double measured_Nm) {
  if (fault_ == NodeFault::silent) return;
  if (fault_ == NodeFault::frozen) {
    (void)bus_.send(last_frame_);
    return;
  }
  const double torque_dNm = std::clamp(std::round(10 * measured_Nm), 0.0, 65535.0);
  const unsigned state = (engaged_ ? 1u : 0u) | (tripped_ ? 2u : 0u) | (command_lost_ ? 4u : 0u);
  hal::CanFrame frame{.id = brake_status_id, .length = 4};
  put_number(frame, 0, 2, static_cast<std::uint64_t>(torque_dNm));
  put_number(frame, 2, 1, state);
  put_number(frame, 3, 1, static_cast<std::uint64_t>(statuses_));
  last_frame_ = frame;
  send_as(bus_, fault_, frame);
}

}  // namespace rvbench::sim
