#pragma once

namespace rvbench::analysis {

/// Where a function that rises reaches `value`: between low and high or, where it is still below at
/// high, beyond.
/// @param high   above 0
/// @param error  how far off the answer may be, as a share of it; 0 is to rounding
template <typename F>
double rising_root(const F& rising, double value, double low, double high, double error = 0) {
  for (int doublings = 0; doublings < 1000 && rising(high) < value; ++doublings) {
    low = high;
    high *= 2;
  }
  for (int halvings = 0; halvings < 100; ++halvings) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high || high - low < error * high) break;
    (rising(middle) < value ? low : high) = middle;
  }
  return high;
}

}  // namespace rvbench::analysis
