#pragma once

#include "hal/can_transport.hpp"
#include "tests/support/wait_until.hpp"

namespace rvbench::test {

inline hal::CanFrame numbered(std::uint32_t id, std::uint8_t number) {
  return {.id = id, .length = 1, .data = {number}};
}

/// The next frame or error; waits for it as long as another thread or process may take.
inline Result<hal::CanFrame> next(hal::CanTransport& can) {
  Result<hal::CanFrame> frame = IoError{IoErrc::timeout, "not asked yet"};
  (void)wait_until([&] {
    frame = can.receive();
    return frame || frame.error().code != IoErrc::timeout;
  });
  return frame;
}

}  // namespace rvbench::test
