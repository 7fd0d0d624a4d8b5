#include "hal/can/frame_clock.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/require_positive.hpp"

namespace rvbench::hal {
namespace {

constexpr double exact_s = 1e-9;
constexpr double most_hurry = 0.05;  // a speed may be wrong by that: less than interlocks' room
constexpr double patience_s = 1;

}  // namespace

FrameClock::FrameClock(double rate_Hz) : period_s_(1 / rate_Hz) {
  require_positive(rate_Hz, "FrameClock", "rate_Hz");
}

double FrameClock::next(double came_s, std::int64_t steps) {
  const double step_s = static_cast<double>(steps) * period_s_;
  const double expected_s = time_s_ + step_s;
  const double late_s = came_s - expected_s;
  if (std::abs(late_s) <= exact_s) {
    time_s_ = came_s;
  } else if (late_s < 0) {
    time_s_ = expected_s + std::max(late_s, -most_hurry * step_s);
  } else {
    time_s_ = expected_s + std::min(late_s, late_s * step_s / patience_s);
  }
  const double share = std::min(1.0, step_s / patience_s);
  uncertainty_s_ += share * (std::abs(came_s - time_s_) - uncertainty_s_);
  return time_s_;
}

}  // namespace rvbench::hal
