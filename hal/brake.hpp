#pragma once

#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

struct BrakeLimits {
  double max_torque_Nm = 0;        ///< at the reducer's output shaft
  double residual_torque_pct = 2;  ///< of that: what it shows at most though it is released
};

struct BrakeStatus {
  double torque_Nm = not_known;  ///< as the brake measures it, at the output shaft
  bool tripped = false;
  double time_s = not_known;  ///< when it was so, on the rig's clock; NaN: when it was read
};

/// Torque-controlled load at the reducer's output shaft. It can only hold back, never drive.
///
/// Order    connect() → { set_torque() | read() }* → release()
/// Time     no call blocks longer than the deadline given at construction
/// Age      read() may hand out what was heard last, for as long as that deadline; time_s tells
/// Threads  one caller at a time
class Brake {
 public:
  virtual ~Brake() = default;
  virtual BrakeLimits limits() const = 0;
  virtual Status connect() = 0;  ///< checks that the device answers, and leaves it released

  /// Call it cyclically: the brake releases by itself when commands stop coming.
  /// @throws std::invalid_argument if torque_Nm is not within [0, limits()]
  virtual Status set_torque(double torque_Nm) = 0;

  virtual Result<BrakeStatus> read() = 0;  ///< fresh within the deadline, or an error

  /// Legal in every state, any number of times; also tries to reach a brake whose link was lost.
  /// @return Done once the command is on its way: read() tells whether the brake has obeyed
  virtual Status release() noexcept = 0;
};

}  // namespace rvbench::hal
