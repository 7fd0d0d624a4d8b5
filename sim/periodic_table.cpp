#include "sim/periodic_table.hpp"

#include <array>
#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::sim {

using units::two_pi;

namespace {

constexpr double lobes_of_a_bump = 2;  // of its spectrum: a raised cosine is over with its second

// cos 2πi/size: all that a harmonic needs, for each of its steps ends on one of these.
template <int size>
const std::array<double, size>& cosines() {
  static const auto table = [] {
    std::array<double, size> values{};
    for (int i = 0; i < size; ++i) {
      values[static_cast<std::size_t>(i)] = std::cos(two_pi * i / size);
    }
    return values;
  }();
  return table;
}

}  // namespace

void PeriodicTable::reserve() {
  if (values_.empty()) values_.assign(size + 1, 0.0);
}

PeriodicTable& PeriodicTable::add_cosine(int harmonic, double amplitude, double phase_rad) {
  if (amplitude == 0) return *this;
  reserve();
  harmonics_.insert(harmonic);
  const auto& cosine = cosines<size>();
  const double a = amplitude * std::cos(phase_rad), b = amplitude * std::sin(phase_rad);
  constexpr std::size_t quarter = size / 4;
  std::size_t at = 0;
  for (double& value : values_) {
    value += a * cosine[at] + b * cosine[(at + quarter) % size];  // cos(x + π/2) = −sin x
    at = (at + static_cast<std::size_t>(harmonic)) % size;
  }
  return *this;
}

PeriodicTable& PeriodicTable::add_bump(double centre_rad, double width_rad, double height) {
  if (height == 0) return *this;
  reserve();
  const auto highest = static_cast<int>(std::ceil(lobes_of_a_bump * two_pi / width_rad));
  for (int harmonic = 1; harmonic <= highest; ++harmonic) harmonics_.insert(harmonic);
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
