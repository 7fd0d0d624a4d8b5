#include "sequences/lateness.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/recording.hpp"

namespace rvbench::sequences {

void Lateness::add(double late_s) noexcept {
  const double steps =
      std::ceil(steps_per_octave * std::log2(std::max(late_s, shortest_s) / shortest_s));
  ++counts_[static_cast<std::size_t>(std::clamp(steps, 0.0, double(counts_.size() - 1)))];
  ++rounds_;
  longest_s_ = std::max(longest_s_, late_s);
}

double Lateness::quantile_s(double share) const {
  if (rounds_ == 0) return not_known;
  const double wanted = share * double(rounds_);
  std::uint64_t passed = 0;
  for (std::size_t step = 0; step < counts_.size(); ++step) {
    passed += counts_[step];
    if (double(passed) >= wanted) {
      const double upper_s = shortest_s * std::exp2(double(step) / steps_per_octave);
      return std::min(upper_s, longest_s_);
    }
  }
  return longest_s_;
}

}  // namespace rvbench::sequences
