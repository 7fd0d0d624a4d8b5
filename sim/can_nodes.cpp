#include "sim/can_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/require_positive.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

constexpr std::uint32_t transducer_id = 0x181;
constexpr std::uint32_t brake_command_id = 0x201;
constexpr std::uint32_t brake_status_id = 0x281;

void put(hal::CanFrame& frame, std::size_t at, std::size_t bytes, std::uint64_t value) {
  for (std::size_t i = 0; i < bytes; ++i) {
    frame.data[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

// Sends as the fault has it. A full bus loses the frame, as on a real one.
void send_as(hal::CanTransport& bus, NodeFault fault, const hal::CanFrame& frame) {
  hal::CanFrame sent = frame;
  if (fault == NodeFault::garbled) sent.length = 3;
  (void)bus.send(sent);
  if (fault == NodeFault::duplicated) (void)bus.send(sent);
}

}  // namespace

TransducerNode::TransducerNode(hal::CanTransport& bus, double rate_Hz)
    : bus_(bus), rate_Hz_(rate_Hz) {
  require_positive(rate_Hz, "TransducerNode", "rate_Hz");
}

void TransducerNode::advance_to(double time_s, double torque_Nm, double angle_rad) {
  const double span_s = time_s - time_s_;
  for (;;) {
    const double due_s = static_cast<double>(samples_) / rate_Hz_;
    if (due_s > time_s) break;
    const double part = span_s > 0 ? (due_s - time_s_) / span_s : 1;
    send_sample(std::lerp(torque_Nm_, torque_Nm, part), std::lerp(angle_rad_, angle_rad, part));
    ++samples_;
  }
  time_s_ = time_s;
  torque_Nm_ = torque_Nm;
  angle_rad_ = angle_rad;
}

void TransducerNode::send_sample(double torque_Nm, double angle_rad) {
  if (fault_ == NodeFault::silent) return;
  if (fault_ == NodeFault::frozen) {
    (void)bus_.send(last_frame_);
    return;
  }
  constexpr double full_scale_uNm = 2147483647.0;
  const double torque_uNm =
      std::clamp(std::round(1e6 * torque_Nm), -full_scale_uNm, full_scale_uNm);
  const double turns = angle_rad / units::two_pi;
  const auto counts = static_cast<std::uint64_t>(65536 * (turns - std::floor(turns)));
  const unsigned flags =
      (flags_.zeroing ? 1u : 0u) | (flags_.overload ? 2u : 0u) | (flags_.shunt_on ? 4u : 0u);
  hal::CanFrame frame{.id = transducer_id, .length = 8};
  put(frame, 0, 4, static_cast<std::uint64_t>(static_cast<std::int64_t>(torque_uNm)));
  put(frame, 4, 2, counts);
  put(frame, 6, 1, static_cast<std::uint64_t>(samples_));
  put(frame, 7, 1, flags);
  last_frame_ = frame;
  if (frames_to_lose_ > 0) {
    --frames_to_lose_;
    return;
  }
  send_as(bus_, fault_, frame);
}

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
  put(frame, 0, 2, static_cast<std::uint64_t>(torque_dNm));
  put(frame, 2, 1, state);
  put(frame, 3, 1, static_cast<std::uint64_t>(statuses_));
  last_frame_ = frame;
  send_as(bus_, fault_, frame);
}

}  // namespace rvbench::sim
