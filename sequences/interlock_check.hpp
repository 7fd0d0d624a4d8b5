#pragma once

#include <optional>
#include <string>

#include "hal/types/outcome.hpp"
#include "sequences/fresh_values.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// The safety trip that a fresh value calls for, if any. Stale values are not looked at: they are
/// a lost device, which is another matter.
std::optional<Ending> check_interlocks(const Interlocks& limits, const FreshValues& fresh);

/// The ERROR of a drive or brake that reports a fault of its own.
std::optional<Ending> check_devices(const FreshValues& fresh);

/// The ERROR of a device that is missing or cannot be trusted; the reason says which.
Ending device_lost(std::string reason);

}  // namespace rvbench::sequences
