#include "analysis/frf/force_pulse.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

namespace {

constexpr double foot_share = 0.1;
constexpr double sigma_of_deviation = 1.4826;  // of a Gaussian's median absolute deviation

struct Rise {
  double height = 0;
  Eigen::Index where = 0;
};

// Largest rise above the lowest value since the peak, walking away from it in steps of `step`.
Rise largest_rise(const Eigen::VectorXd& force, Eigen::Index peak, Eigen::Index step) {
  Rise rise{0, peak};
  double lowest = force[peak];
  for (Eigen::Index i = peak; i >= 0 && i < force.size(); i += step) {
    lowest = std::min(lowest, std::max(force[i], 0.0));
    if (force[i] - lowest > rise.height) rise = {force[i] - lowest, i};
  }
  return rise;
}

double median_of(const Eigen::VectorXd& x) {
  return median(std::vector<double>(x.data(), x.data() + x.size()));
}

}  // namespace

ForcePulse force_pulse(const Eigen::Ref<const Eigen::VectorXd>& force) {
  constexpr Require require{"force_pulse"};
  require(force.size() >= 16 && force.allFinite(), "needs 16 finite samples or more");
  ForcePulse pulse;
  pulse.rest = median_of(force);
  Eigen::VectorXd x = force.array() - pulse.rest;
  x.cwiseAbs().maxCoeff(&pulse.peak);
  pulse.height = x[pulse.peak];
  pulse.noise = sigma_of_deviation * median_of(x.cwiseAbs());
  if (pulse.height < 0) x = -x;

  const double foot = foot_share * x[pulse.peak];
  pulse.first = pulse.last = pulse.peak;
  while (pulse.first > 0 && x[pulse.first - 1] > foot) --pulse.first;
  while (pulse.last + 1 < x.size() && x[pulse.last + 1] > foot) ++pulse.last;

  const Rise before = largest_rise(x, pulse.peak, -1);
  const Rise after = largest_rise(x, pulse.peak, 1);
  const Rise second = before.height > after.height ? before : after;
  pulse.second_height = second.height;
  pulse.second = second.where;
  return pulse;
}

}  // namespace rvbench::analysis
