#pragma once

#include <cstdint>
#include <deque>

namespace rvbench::hal {

/// Tells when a sample of a device with a clock of its own was taken, on the rig's clock, from when
/// blocks of samples arrived.
///
/// A block may arrive late, and never early: of each second only the most punctual one counts. A
/// line through those of the last minute gives the rate at which the device's clock really runs.
/// What every block needs at the least (transport, filters of the converter) cannot be seen and
/// stays in: on one machine some 0.1 ms, over a network its shortest way.
class SampleClock {
 public:
  /// @throws std::invalid_argument if nominal_rate_Hz is not finite and positive
  explicit SampleClock(double nominal_rate_Hz);

  /// @param samples    since the start, those of this block included
  /// @param arrival_s  of the block; does not go back
  void add(std::int64_t samples, double arrival_s);

  /// When that sample was taken; 0 is the first. @pre a block has been added
  double time_s(std::int64_t sample) const;
  double rate_Hz() const;        ///< as it really is; the nominal one for the first five seconds
  double uncertainty_s() const;  ///< scatter of the punctual blocks; NaN before the third second

  /// Time that the samples fall short of what has passed: a hole in the stream. 0 if there is none
  /// that is longer than 5 ms and five times the scatter: a shorter one cannot be told from blocks
  /// that come late. A longer one is found within hole_found_within_s. Not before the third second
  double missing_s() const { return missing_s_; }

  /// Two of the seconds of which the most punctual block counts, each as long as a block more.
  static constexpr double hole_found_within_s = 2.5;

 private:
  struct Block {
    double sample, arrival_s;  // of its newest
  };

  double lateness_s(const Block& block) const;
  void close_second();
  void fit();

  double nominal_rate_Hz_;
  double period_s_;     ///< of a sample, as fitted
  double start_s_ = 0;  ///< of sample 0, as fitted
  bool has_block_ = false;
  double second_ends_s_ = 0;
  Block punctual_{};  ///< of the second that runs
  std::deque<Block> seconds_;
  double uncertainty_s_;
  double missing_s_ = 0;
};

}  // namespace rvbench::hal
