#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "hal/types/result.hpp"

namespace rvbench::hal {

/// What a bus interface has counted of what went wrong. A count that rises means that frames may
/// be missing or false. What is normal on a bus is not among them: losing an arbitration.
struct BusCounters {
  std::string interface;                        ///< "can0"
  std::map<std::string, std::uint64_t> counts;  ///< by the interface's own names: "rx_dropped"
};

/// Reads the counters of one bus interface.
///
/// Time     read() may take as long as the interface needs to answer, 0.3 s at most
/// Threads  one caller at a time, beside whoever uses the bus
class BusMonitor {
 public:
  virtual ~BusMonitor() = default;
  virtual Result<BusCounters> read() = 0;
};

}  // namespace rvbench::hal
