#pragma once

#include <cstdint>

#include "hal/can_transport.hpp"
#include "sim/can_node_frames.hpp"

namespace rvbench::sim {

/// What a transducer reports about itself.
struct TransducerFlags {
  bool zeroing = false;
  bool overload = false;
  bool shunt_on = false;
};

/// Rotating torque transducer with angle: one frame 0x181 per sample, at multiples of 1/rate.
///
/// Frame    int32 torque in µN·m, uint16 angle in 1/65536 turns, uint8 rolling counter,
///          uint8 flags (1 zeroing, 2 overload, 4 shunt on); least significant byte first
/// Threads  one caller at a time: the plant
class TransducerNode {
 public:
  /// @param bus  must outlive the node
  /// @throws std::invalid_argument if rate_Hz is not finite and positive
  TransducerNode(hal::CanTransport& bus, double rate_Hz);

  /// Tells torque and angle at `time_s`; sends the samples due since the last call, linearly
  /// interpolated between the two calls.
  void advance_to(double time_s, double torque_Nm, double angle_rad);

  double rate_Hz() const { return rate_Hz_; }
  void set_flags(TransducerFlags flags) { flags_ = flags; }
  void set_fault(NodeFault fault) { fault_ = fault; }
  void lose_frames(int count) { frames_to_lose_ = count; }  ///< the next ones; counter goes on

 private:
  void send_sample(double torque_Nm, double angle_rad);

  hal::CanTransport& bus_;
  double rate_Hz_;
  TransducerFlags flags_;
  NodeFault fault_ = NodeFault::none;
  int frames_to_lose_ = 0;
  std::int64_t samples_ = 0;  ///< sent or due so far
  double time_s_ = 0;
  double torque_Nm_ = 0;
  double angle_rad_ = 0;
  hal::CanFrame last_frame_;
};

}  // namespace rvbench::sim
