#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace seal {

/// Random numbers that follow from a seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  double uniform(double from, double to) {
    constexpr double steps = 9007199254740992.0;  // equally likely values of a double below 1
    return from + (to - from) * static_cast<double>(engine_() >> 11) / steps;
  }
  double normal() {
    const double size = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return size * std::cos(uniform(0, 2 * std::numbers::pi));
  }
  double phase_rad() { return uniform(-std::numbers::pi, std::numbers::pi); }
  double within_factor(double factor) { return std::pow(factor, uniform(-1, 1)); }
  double sign() { return uniform(-1, 1) < 0 ? -1 : 1; }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform(0, static_cast<double>(count)));
  }
  bool one_in(std::size_t times) { return below(times) == 0; }
  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace seal
