#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/can_transport.hpp"

namespace rvbench::sim {

/// How a CAN node misbehaves. A real node on a real bus can do each of these.
enum class NodeFault {
  none,
  silent,      ///< sends nothing
  frozen,      ///< sends its last frame again and again
  duplicated,  ///< sends each frame twice
  garbled      ///< sends frames of the wrong length
};

/// Sends as the fault has it. A full bus loses the frame, as on a real one.
void send_as(hal::CanTransport& bus, NodeFault fault, const hal::CanFrame& frame);

/// Puts a number into a frame's bytes, least significant first.
void put_number(hal::CanFrame& frame, std::size_t at, std::size_t bytes, std::uint64_t value);

}  // namespace rvbench::sim
