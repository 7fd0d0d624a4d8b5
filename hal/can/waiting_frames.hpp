#pragma once

#include "hal/can_transport.hpp"

namespace rvbench::hal {

/// Hands each frame that waits to `take`, until none is left.
/// @param take  Status(const CanFrame&): the first that it refuses ends it, those behind it wait on
template <typename Take>
Status take_waiting_frames(CanTransport& transport, Take take) {
  for (;;) {
    const Result<CanFrame> received = transport.receive();
    if (!received) {
      if (received.error().code == IoErrc::timeout) return Done{};
      return received.error();
    }
    const Status taken = take(received.value());
    if (!taken) return taken;
  }
}

inline void drop_waiting_frames(CanTransport& transport) {
  while (transport.receive()) continue;
}

}  // namespace rvbench::hal
