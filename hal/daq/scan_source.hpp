#pragma once

#include "hal/accelerometers.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

/// A DAQ device that makes whoever reads it wait. A new kind of device is a new file that
/// implements this; StreamedAccelerometers makes the role of it.
///
/// Order    connect() → start() → wait()* → stop(), and start() again
/// Threads  one caller at a time, but for interrupt(), which comes while another thread waits
class ScanSource {
 public:
  virtual ~ScanSource() = default;
  virtual Status connect() = 0;           ///< finds device and inputs, sets the rate
  virtual double rate_Hz() const = 0;     ///< that it really runs at; asked for before connect()
  virtual double range_m_s2() const = 0;  ///< full scale of the least sensitive input
  virtual Status start() = 0;

  /// Waits for scans, for a deadline of its own, and makes `scans` those that have come: n x
  /// inputs, m/s². None is no error. A device that lost some says overrun; its later scans cannot
  /// be placed.
  virtual Status wait(AccelerationBlock::Scans& scans) = 0;
  virtual void interrupt() noexcept = 0;  ///< wait() returns soon, and there are no more scans
  virtual void stop() noexcept = 0;       ///< legal in every state
};

}  // namespace rvbench::hal
