#pragma once

#include <thread>

#include "hal/can_transport.hpp"

namespace rvbench::sim {

/// Hands the frames of one CAN bus on to another, both ways: the simulated nodes become those of a
/// real interface. A frame that the other bus does not take at once is lost, as on a bus.
///
/// Time     within 1 ms of real time
/// Threads  in a thread of its own from construction to destruction; the other ends of both buses
///          may live in other threads
class CanBridge {
 public:
  /// @param one, other  open; both must outlive the bridge, which alone receives from them
  CanBridge(hal::CanTransport& one, hal::CanTransport& other);

 private:
  std::jthread thread_;
};

}  // namespace rvbench::sim
