#include "analysis/order/over_angle.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/order/sinc_interpolator.hpp"
#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index taps = 64;
constexpr Eigen::Index smoothed_steps = 16;  // to each side, that tell how wide a step is in time

const SincInterpolator& interpolator() {
  static const SincInterpolator sinc(taps, 10.06);  // 100 dB: passes 0.44 of the rate
  return sinc;
}

// How much of x's band fits between even steps around one: 1 where steps are the finer ones.
double cut_at(const Eigen::VectorXd& times_s, Eigen::Index i, double rate_Hz) {
  const Eigen::Index from = std::max<Eigen::Index>(i - smoothed_steps, 0);
  const Eigen::Index to = std::min(i + smoothed_steps, times_s.size() - 1);
  const double step_s = (times_s[to] - times_s[from]) / static_cast<double>(to - from);
  return std::min(1.0, 1 / (step_s * rate_Hz));
}

}  // namespace

OverAngle over_angle(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz, double start_s,
                     const ShaftAngle& angle, const EvenSteps& steps) {
  constexpr Require require{"over_angle"};
  require_positive(rate_Hz, "over_angle", "rate_Hz");
  require_positive(steps.period_turns, "over_angle", "period_turns");
  require(steps.samples_per_turn > 0, "samples_per_turn must be above 0");
  const double per_period = steps.period_turns * steps.samples_per_turn;
  require(std::abs(per_period - std::round(per_period)) < 1e-6 * per_period && per_period > 0.5,
          "a period must hold a whole number of samples");
  require(x.allFinite(), "a sample is not finite");

  const double periods = angle.whole_periods(x.size(), rate_Hz, start_s, steps.period_turns);
  if (!(periods >= 1)) return {{}, steps.samples_per_turn, 0};
  OverAngle even{{}, steps.samples_per_turn, angle.turns_at(start_s)};
  const auto count = static_cast<Eigen::Index>(std::llround(periods * per_period));
  const Eigen::VectorXd times_s = angle.times_s(even.first_turns, steps.samples_per_turn, count);
  even.samples.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    even.samples[i] = interpolator().at(x, (times_s[i] - start_s) * rate_Hz,
                                        count > 1 ? cut_at(times_s, i, rate_Hz) : 1);
  }
  return even;
}

}  // namespace rvbench::analysis
