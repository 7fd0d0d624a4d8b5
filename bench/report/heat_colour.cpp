#include "bench/report/heat_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rvbench::bench::report {

std::string heat_colour(double share) {
  constexpr std::array<std::array<double, 3>, 5> steps{
      {{255, 255, 255}, {253, 231, 159}, {249, 160, 75}, {206, 58, 60}, {82, 12, 58}}};
  const double at = std::clamp(std::isnan(share) ? 0.0 : share, 0.0, 1.0) * (steps.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), steps.size() - 2);
  const auto mixed = [&](std::size_t c) {
    return static_cast<int>(
        std::lround(std::lerp(steps[low][c], steps[low + 1][c], at - static_cast<double>(low))));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

}  // namespace rvbench::bench::report
