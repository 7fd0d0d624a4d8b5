#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "hal/types/units.hpp"

namespace rvbench::sim {

/// Seeded draws of parameters: the same seed gives the same values on every machine.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  /// Within a factor of `factor` each way, as likely above as below.
  double within_factor(double factor) { return std::exp(uniform(-1, 1) * std::log(factor)); }
  double phase_rad() { return uniform(0, units::two_pi); }
  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace rvbench::sim
