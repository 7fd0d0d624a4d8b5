#include "hal/can/can_frames.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace rvbench::hal::can_frames {
namespace {

unsigned word_at(const CanFrame& frame, std::size_t at) {
  return frame.data[at] | static_cast<unsigned>(frame.data[at + 1]) << 8;
}

}  // namespace

std::optional<TorqueFrame> torque_from_frame(const CanFrame& frame) {
  if (frame.id != torque_id || frame.length != 8 || frame.data[7] > 7) return std::nullopt;
  const auto torque_uNm = static_cast<std::int32_t>(word_at(frame, 0) | word_at(frame, 2) << 16);
  const unsigned status = frame.data[7];
  return TorqueFrame{.torque_Nm = 1e-6 * torque_uNm,
                     .angle_turns = word_at(frame, 4) / 65536.0,
                     .counter = frame.data[6],
                     .zeroing = (status & 1) != 0,
                     .overload = (status & 2) != 0,
                     .shunt_on = (status & 4) != 0};
}

std::optional<BrakeStatusFrame> brake_status_from_frame(const CanFrame& frame) {
  if (frame.id != brake_status_id || frame.length != 4 || frame.data[2] > 7) return std::nullopt;
  const unsigned state = frame.data[2];
  return BrakeStatusFrame{.torque_Nm = word_at(frame, 0) / 10.0,
                          .engaged = (state & 1) != 0,
                          .tripped = (state & 2) != 0,
                          .command_lost = (state & 4) != 0,
                          .counter = frame.data[3]};
}

CanFrame frame_from_brake_command(const BrakeCommandFrame& command) {
  if (!(command.torque_Nm >= 0 && command.torque_Nm <= max_brake_torque_Nm)) {
    throw std::invalid_argument(
        fmt::format("frame_from_brake_command: {} N·m is not within 0 to {}", command.torque_Nm,
                    max_brake_torque_Nm));
  }
  const auto torque_dNm = static_cast<unsigned>(std::lround(10 * command.torque_Nm));
  CanFrame frame{.id = brake_command_id, .length = 4};
  frame.data[0] = static_cast<std::uint8_t>(torque_dNm & 0xFF);
  frame.data[1] = static_cast<std::uint8_t>(torque_dNm >> 8);
  frame.data[2] = command.enable ? 1 : 0;
  frame.data[3] = command.counter;
  return frame;
}

}  // namespace rvbench::hal::can_frames
