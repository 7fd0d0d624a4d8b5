#include "analysis/order/inverter_speed.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "analysis/order/natural_spline.hpp"
#include "hal/types/require_positive.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t fewest_samples = 4;
constexpr Eigen::Index steps_per_sample = 8;

}  // namespace

std::optional<ShaftAngle> angle_of_speed(const Channel& speed_rad_s) {
  require_positive(speed_rad_s.rate_Hz, "angle_of_speed", "rate_Hz");
  std::vector<double> at, turns_per_s;
  for (Eigen::Index i = 0; i < speed_rad_s.samples.size(); ++i) {
    if (!std::isfinite(speed_rad_s.samples[i])) continue;
    at.push_back(static_cast<double>(i) / speed_rad_s.rate_Hz);
    turns_per_s.push_back(speed_rad_s.samples[i] / units::two_pi);
  }
  if (at.size() < fewest_samples) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(at.size());
  const NaturalSpline speed(Eigen::Map<const Eigen::VectorXd>(at.data(), n),
                            Eigen::Map<const Eigen::VectorXd>(turns_per_s.data(), n));
  const Eigen::Index steps = steps_per_sample * (speed_rad_s.samples.size() - 1);
  const double step_s = 1 / (speed_rad_s.rate_Hz * static_cast<double>(steps_per_sample));
  Eigen::VectorXd turns(steps + 1);
  for (Eigen::Index i = 0; i <= steps; ++i) turns[i] = speed.integral(double(i) * step_s);
  return ShaftAngle::of_turns(std::move(turns), speed_rad_s.start_s, step_s);
}

}  // namespace rvbench::analysis
