#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal/can_transport.hpp"

namespace rvbench::hal {

/// Splits one bus into ports, one per identifier: each receives only frames of its own and sends
/// to the bus. So each device has a transport to itself and none takes the frames of another.
///
/// Frames with other identifiers are dropped. A port that nobody reads keeps its newest 4096
/// frames. An error of the bus is told to every port once, after the frames that wait there.
///
/// Threads  the ports share the bus: one caller at a time for all of them together
std::vector<std::unique_ptr<CanTransport>> split_by_id(std::unique_ptr<CanTransport> bus,
                                                       const std::vector<std::uint32_t>& ids);

}  // namespace rvbench::hal
