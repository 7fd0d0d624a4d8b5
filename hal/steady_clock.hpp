#pragma once

#include <chrono>

#include "hal/clock.hpp"

namespace rvbench::hal {

/// Real time: seconds since construction, of the monotonic clock.
class SteadyClock final : public Clock {
 public:
  double now_s() const override;
  void wait_until(double time_s) override;
  bool is_virtual() const override { return false; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace rvbench::hal
