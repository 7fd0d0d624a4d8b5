#pragma once

#include <vector>

#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

/// One sample of the rotating torque transducer between coupling and reducer.
struct TorqueSample {
  double torque_Nm = not_known;  ///< at the input shaft; NaN where a frame was lost
  double angle_rad = not_known;  ///< of the input shaft, unwrapped since connect()
};

/// Samples in a row, without gaps: lost ones are there as NaN.
struct TorqueBlock {
  double t0_s = 0;  ///< time of samples[0] on the rig's clock
  std::vector<TorqueSample> samples;
  int lost = 0;                           ///< how many of them are NaN
  double time_uncertainty_s = not_known;  ///< of t0_s
};

/// Torque transducer with incremental angle.
///
/// Order    connect() → read()*
/// Time     read() returns what has come since the last call, if only an empty block, and does not
///          wait for more: interlocks are not looked at meanwhile. It is an error if nothing new
///          came within the deadline given at construction
class TorqueSensor {
 public:
  virtual ~TorqueSensor() = default;
  virtual double rate_Hz() const = 0;
  virtual Status connect() = 0;
  virtual Result<TorqueBlock> read() = 0;
};

}  // namespace rvbench::hal
