#pragma once

#include <optional>
#include <string>

#include "hal/types/outcome.hpp"
#include "sequences/bench_devices.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// The safety trip that a fresh value calls for, if any. Stale values are not looked at: they are
/// a lost device, which is another matter.
std::optional<Ending> check_interlocks(const Interlocks& limits, const FreshValues& fresh);

/// The ERROR of a drive or brake that reports a fault of its own.
std::optional<Ending> check_devices(const FreshValues& fresh);

/// The ERROR of devices that have not been seen for longer than that.
std::optional<Ending> check_lost(const BenchDevices& devices, double stale_after_s);

/// The ERROR of a device that is missing or cannot be trusted; the reason says which.
Ending device_lost(std::string reason);

}  // namespace rvbench::sequences
