#pragma once

#include <cstdint>

namespace rvbench::hal {

/// When the samples of a stream were taken, from when they came. They are taken evenly and come
/// late, each by another while: of its adapter, its driver, a busy computer. Two arrivals 5 ms
/// apart may be 10 ms of the shaft's motion, and a speed made of them twice too high.
///
/// A sample is expected one period after the one before. If it came earlier than that, the ones
/// before were told too late: the time goes towards it by 5 % of the period. If it came later, by
/// so much of its lateness as a period is of 1 s: so a stream whose rate is not quite the stated
/// one is followed, 8 ms behind if it is 0.8 % slower. What comes when expected, within 1 ns, has
/// the time at which it came.
///
/// How sure its times are, the arrivals tell: how far they are off them on average.
class FrameClock {
 public:
  /// @throws std::invalid_argument if rate_Hz is not finite and positive
  explicit FrameClock(double rate_Hz);

  /// Starts anew: this sample was taken when it came.
  void start(double came_s) { time_s_ = came_s; }

  /// @param steps  samples since the one before, at least 1
  /// @return when this one was taken
  double next(double came_s, std::int64_t steps);

  /// Mean distance of when samples came and when they were taken, over the last second.
  double uncertainty_s() const { return uncertainty_s_; }

 private:
  double period_s_;
  double time_s_ = 0;
  double uncertainty_s_ = 0;
};

}  // namespace rvbench::hal
