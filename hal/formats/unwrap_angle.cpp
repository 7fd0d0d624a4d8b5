#include "hal/formats/unwrap_angle.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr double turn_rad = units::two_pi;

bool is_wrapped(const Eigen::VectorXd& angle_rad) {
  constexpr double rounding = 1.001;
  std::vector<double> steps_rad;
  double before = not_known, least = not_known, most = not_known;
  for (const double rad : angle_rad) {
    if (!std::isfinite(rad)) continue;
    if (std::isfinite(before)) steps_rad.push_back(std::abs(rad - before));
    least = std::fmin(least, rad);
    most = std::fmax(most, rad);
    before = rad;
  }
  if (steps_rad.empty() || most - least > rounding * turn_rad) return false;
  if (std::ranges::max(steps_rad) <= turn_rad / 2) return false;
  const auto middle = steps_rad.begin() + std::ssize(steps_rad) / 2;
  std::ranges::nth_element(steps_rad, middle);
  return *middle < turn_rad / 4;
}

}  // namespace

bool unwrap_angle(Eigen::VectorXd& angle_rad) {
  if (!is_wrapped(angle_rad)) return false;
  double turns = 0, before = not_known;
  for (double& rad : angle_rad) {
    if (!std::isfinite(rad)) continue;
    if (std::isfinite(before)) turns -= std::round((rad - before) / turn_rad);
    before = rad;
    rad += turns * turn_rad;
  }
  return true;
}

}  // namespace rvbench::hal::formats
