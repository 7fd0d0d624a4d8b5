#pragma once

#include <string>
#include <vector>

#include "hal/bus_monitor.hpp"
#include "hal/rig.hpp"

namespace rvbench::sequences {

/// Tells whether the buses of a rig were in order over a record: whether any counter of what goes
/// wrong has moved between begin() and end(). Counters that cannot be read are not in order.
class BusWatch {
 public:
  explicit BusWatch(const hal::Rig& rig) : rig_(rig) {}

  void begin();

  /// "can0: bus_error +3, rx_dropped +1; can1: ..."; empty if all was in order.
  std::string end() const;

 private:
  const hal::Rig& rig_;
  std::vector<Result<hal::BusCounters>> before_;
};

}  // namespace rvbench::sequences
