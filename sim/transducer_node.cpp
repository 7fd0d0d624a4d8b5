#include "sim/transducer_node.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/require_positive.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

constexpr std::uint32_t transducer_id = 0x181;

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
  put_number(frame, 0, 4, static_cast<std::uint64_t>(static_cast<std::int64_t>(torque_uNm)));
  put_number(frame, 4, 2, counts);
  put_number(frame, 6, 1, static_cast<std::uint64_t>(samples_));
  put_number(frame, 7, 1, flags);
  last_frame_ = frame;
  if (frames_to_lose_ > 0) {
    --frames_to_lose_;
    return;
  }
  send_as(bus_, fault_, frame);
}

}  // namespace rvbench::sim
