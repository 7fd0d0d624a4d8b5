#pragma once

#include <algorithm>

#include "hal/clock.hpp"

namespace rvbench::hal {

/// Virtual time: stands still but for wait_until().
class SteppedClock final : public Clock {
 public:
  double now_s() const override { return now_s_; }
  void wait_until(double time_s) override { now_s_ = std::max(now_s_, time_s); }
  bool is_virtual() const override { return true; }

 private:
  double now_s_ = 0;
};

}  // namespace rvbench::hal
