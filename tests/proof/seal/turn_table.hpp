#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace seal {

/// A function of an angle, stored over one turn.
class TurnTable {
 public:
  /// @param shape  of an angle in [0, 2π)
  template <class Shape>
  explicit TurnTable(Shape shape, std::size_t size = 16384) : values_(size) {
    for (std::size_t i = 0; i < size; ++i) {
      values_[i] = shape(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size));
    }
  }

  double operator()(double angle_rad) const {
    const double turns = angle_rad / (2 * std::numbers::pi);
    const double at = (turns - std::floor(turns)) * static_cast<double>(values_.size());
    const auto below = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(below);
    const double first = values_[below % values_.size()];
    return first + share * (values_[(below + 1) % values_.size()] - first);
  }

 private:
  std::vector<double> values_;
};

}  // namespace seal
