#include "sim/periodic_table.hpp"

#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::sim {

using units::two_pi;

void PeriodicTable::reserve() {
  if (values_.empty()) values_.assign(size + 1, 0.0);
}

PeriodicTable& PeriodicTable::add_cosine(int harmonic, double amplitude, double phase_rad) {
  if (amplitude == 0) return *this;
  reserve();
  for (int i = 0; i <= size; ++i) {
    values_[static_cast<std::size_t>(i)] +=
        amplitude * std::cos(harmonic * two_pi * i / size + phase_rad);
  }
  return *this;
}

PeriodicTable& PeriodicTable::add_bump(double centre_rad, double width_rad, double height) {
  if (height == 0) return *this;
  reserve();
  for (int i = 0; i <= size; ++i) {
    const double away_rad = std::remainder(two_pi * i / size - centre_rad, two_pi);
    if (std::abs(away_rad) < width_rad / 2) {
      values_[static_cast<std::size_t>(i)] +=
          height * 0.5 * (1 + std::cos(two_pi * away_rad / width_rad));
    }
  }
  return *this;
}

double PeriodicTable::operator()(double angle_rad) const {
  if (values_.empty()) return 0;
  const double turns = angle_rad / two_pi;
  const double place = (turns - std::floor(turns)) * size;
  const auto i = static_cast<std::size_t>(place);
  if (i >= size) return values_[0];
  return values_[i] + (place - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
}

}  // namespace rvbench::sim
