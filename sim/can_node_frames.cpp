#include "sim/can_node_frames.hpp"

namespace rvbench::sim {

void send_as(hal::CanTransport& bus, NodeFault fault, const hal::CanFrame& frame) {
  hal::CanFrame sent = frame;
  if (fault == NodeFault::garbled) sent.length = 3;
  (void)bus.send(sent);
  if (fault == NodeFault::duplicated) (void)bus.send(sent);
}

void put_number(hal::CanFrame& frame, std::size_t at, std::size_t bytes, std::uint64_t value) {
  for (std::size_t i = 0; i < bytes; ++i) {
    frame.data[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

}  // namespace rvbench::sim
