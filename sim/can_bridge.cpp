#include "sim/can_bridge.hpp"

#include <chrono>

namespace rvbench::sim {
namespace {

bool hand_on(hal::CanTransport& from, hal::CanTransport& to) {
  const auto frame = from.receive();
  if (frame) (void)to.send(frame.value());
  return static_cast<bool>(frame);
}

}  // namespace

CanBridge::CanBridge(hal::CanTransport& one, hal::CanTransport& other)
    : thread_([&one, &other](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          bool any = hand_on(one, other);
          any = hand_on(other, one) || any;
          if (!any) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
      }) {}

}  // namespace rvbench::sim
