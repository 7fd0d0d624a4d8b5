#include "sim/hammer_tap.hpp"

#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::sim {

double HammerTap::step() {
  if (is_over()) return 0;
  const double force_N = peak_N * std::sin(0.5 * units::two_pi * time_s_ / width_s);
  time_s_ += 1 / rate_Hz_;
  return force_N;
}

}  // namespace rvbench::sim
