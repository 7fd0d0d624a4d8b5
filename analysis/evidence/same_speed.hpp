#pragma once

#include <cmath>

namespace rvbench::analysis {

/// Whether two points are of one speed: further apart, a line that stands still in Hz has left the
/// order that it had.
/// Units  rpm, signed either way
inline bool is_same_speed(double one_rpm, double other_rpm) {
  constexpr double same = 0.02;  // relative
  return std::abs(std::abs(one_rpm / other_rpm) - 1) < same;
}

}  // namespace rvbench::analysis
