#pragma once

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "hal/can_transport.hpp"
#include "hal/steady_clock.hpp"

namespace rvbench::test {

inline void shell(const std::string& command) {
  INFO(command);
  REQUIRE(std::system(command.c_str()) == 0);
}

inline hal::CanFrame numbered(std::uint32_t id, std::uint8_t number) {
  return {.id = id, .length = 1, .data = {number}};
}

/// The next frame or error; waits for it as long as another process may take.
inline Result<hal::CanFrame> next(hal::CanTransport& can) {
  for (int i = 0; i < 2000; ++i) {
    auto frame = can.receive();
    if (frame || frame.error().code != IoErrc::timeout) return frame;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return IoError{IoErrc::timeout, "nothing in two seconds"};
}

}  // namespace rvbench::test
