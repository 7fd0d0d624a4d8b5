#include "analysis/compare/block_spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/order/order_map.hpp"
#include "analysis/order/resolution.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fewest_turns = 64;

}  // namespace

double whole_period(const Kinematics& kinematics) {
  const double turns = std::round(kinematics.period_turns);
  return turns >= 1 && std::abs(kinematics.period_turns - turns) < 1e-9 ? turns : 1;
}

int block_turns(const Kinematics& kinematics) {
  const double period = whole_period(kinematics);
  return static_cast<int>(period * std::max(lines_to_part, std::ceil(fewest_turns / period)));
}

OverAngle over_periods(const Channel& x, const ShaftAngle& angle, const Kinematics& kinematics) {
  const int per_turn = static_cast<int>(std::ceil(x.rate_Hz / angle.mean_speed_Hz()));
  return over_angle(x.samples, x.rate_Hz, x.start_s, angle, {per_turn, whole_period(kinematics)});
}

Spectrum block_spectrum(const OverAngle& x, const ShaftAngle& angle, int turns) {
  const OrderMap map = order_map(x, angle, turns);
  if (map.amplitude.cols() == 0) return {map.resolution, {}};
  return {map.resolution, map.amplitude.cwiseAbs2().rowwise().mean().cwiseSqrt()};
}

}  // namespace rvbench::analysis
