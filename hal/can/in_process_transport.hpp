#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "hal/can_transport.hpp"

namespace rvbench::hal {

/// The two ends of a bus inside this process: what one sends the other receives.
struct InProcessBus {
  std::unique_ptr<CanTransport> bench;
  std::unique_ptr<CanTransport> nodes;
};

/// Makes a bus whose ends may live in different threads and outlive each other. Frames that wait
/// beyond `capacity` push out the oldest: a controller's receive queue does not wait either.
/// @param now_s  stamps the frames when they are sent; called in the sender's thread
InProcessBus make_in_process_bus(std::function<double()> now_s, std::size_t capacity = 4096);

}  // namespace rvbench::hal
