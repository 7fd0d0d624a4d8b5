#pragma once

#include <cstdint>
#include <memory>

#include "hal/clock.hpp"
#include "hal/drive.hpp"

namespace rvbench::test {

/// A driver that does all but one thing: after a time-out it goes on over the same connection, and
/// takes whatever comes next for the answer. One late reply, and it lives in the past.
///
/// @param clock  must outlive it; each time-out is charged to it
/// @param patience_s  real time until a reply counts as lost
std::unique_ptr<hal::Drive> make_undrained_drive(std::uint16_t port, hal::Clock& clock,
                                                 double response_timeout_s, double patience_s);

}  // namespace rvbench::test
