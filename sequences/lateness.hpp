#pragma once

#include <array>
#include <cstdint>

namespace rvbench::sequences {

/// How late the rounds of a loop began: a histogram that costs next to nothing, in steps of 9 %
/// from 1 µs to more than an hour.
class Lateness {
 public:
  void add(double late_s) noexcept;

  std::uint64_t rounds() const { return rounds_; }
  double quantile_s(double share) const;  ///< no more than 9 % too large; NaN without rounds
  double longest_s() const { return longest_s_; }

 private:
  static constexpr int steps_per_octave = 8;
  static constexpr double shortest_s = 1e-6;

  std::array<std::uint64_t, 256> counts_{};
  std::uint64_t rounds_ = 0;
  double longest_s_ = 0;
};

}  // namespace rvbench::sequences
