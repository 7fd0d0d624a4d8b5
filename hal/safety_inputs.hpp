#pragma once

#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

struct SafetyStatus {
  bool estop_pressed = true;  ///< the hard-wired chain is open; rvbench only observes it
  bool guard_open = true;
  double housing_temp_degC = not_known;
  double time_s = not_known;  ///< when it was so, on the rig's clock; NaN: when it was read
};

/// Read-only view of the safety chain and of the slow housekeeping sensors.
///
/// Age      a device may hand out what it has heard last, for as long as its deadline; time_s tells
class SafetyInputs {
 public:
  virtual ~SafetyInputs() = default;
  virtual Status connect() = 0;
  virtual Result<SafetyStatus> read() = 0;  ///< fresh within the deadline, or an error
};

}  // namespace rvbench::hal
