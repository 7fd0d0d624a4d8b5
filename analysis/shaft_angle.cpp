#include "analysis/shaft_angle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index taps = 32;     // of the interpolator
constexpr Eigen::Index phases = 256;  // tabulated between two samples, straight lines between them
constexpr double kaiser_beta = 5.65;  // 60 dB: passes 0.44 of the rate, stops from 0.56 on

using Taps = Eigen::Matrix<double, taps, 1>;

// A sinc under a Kaiser window, by place between two samples. Each column sums to 1.
// Source  Oppenheim & Schafer, Discrete-Time Signal Processing, ch. 7 (window design)
Eigen::Matrix<double, taps, Eigen::Dynamic> make_kernel() {
  Eigen::Matrix<double, taps, Eigen::Dynamic> kernel(taps, phases + 1);
  for (Eigen::Index phase = 0; phase <= phases; ++phase) {
    for (Eigen::Index tap = 0; tap < taps; ++tap) {
      const double away = static_cast<double>(phase) / phases - static_cast<double>(tap + 1) +
                          static_cast<double>(taps) / 2;
      const double x = std::numbers::pi * away;
      const double sinc = std::abs(x) < 1e-12 ? 1 : std::sin(x) / x;
      const double edge = std::min(1.0, std::abs(away) * 2 / static_cast<double>(taps));
      kernel(tap, phase) = sinc * std::cyl_bessel_i(0, kaiser_beta * std::sqrt(1 - edge * edge));
    }
    kernel.col(phase) /= kernel.col(phase).sum();
  }
  return kernel;
}

// x between its samples; held beyond its ends.
double at(const Eigen::Ref<const Eigen::VectorXd>& x, double place) {
  static const auto kernel = make_kernel();
  const Eigen::Index last = x.size() - 1;
  const auto i = std::clamp(static_cast<Eigen::Index>(std::floor(place)), Eigen::Index{0}, last);
  const double phase = std::clamp(place - static_cast<double>(i), 0.0, 1.0) * phases;
  const auto below = std::min(static_cast<Eigen::Index>(phase), phases - 1);
  const double weight = phase - static_cast<double>(below);
  const Taps weights = (1 - weight) * kernel.col(below) + weight * kernel.col(below + 1);
  const Eigen::Index first = i - taps / 2 + 1;
  if (first >= 0 && first + taps <= x.size()) return weights.dot(x.segment<taps>(first));
  double sum = 0;
  for (Eigen::Index tap = 0; tap < taps; ++tap) {
    sum += weights[tap] * x[std::clamp(first + tap, Eigen::Index{0}, last)];
  }
  return sum;
}

double end_s(const Channel& channel) {
  return channel.start_s + static_cast<double>(channel.samples.size()) / channel.rate_Hz;
}

// Lost angle samples are bridged: the shaft cannot jump.
Eigen::VectorXd bridged_turns(const Channel& angle) {
  Eigen::VectorXd turns = angle.samples / units::two_pi;
  Eigen::Index good = -1;
  for (Eigen::Index i = 0; i < turns.size(); ++i) {
    if (!std::isfinite(turns[i])) continue;
    for (Eigen::Index k = good + 1; k < i; ++k) {
      turns[k] = good < 0 ? turns[i]
                          : turns[good] + (turns[i] - turns[good]) * static_cast<double>(k - good) /
                                              static_cast<double>(i - good);
    }
    good = i;
  }
  return good < 0 ? Eigen::VectorXd{} : Eigen::VectorXd(turns.head(good + 1));
}

}  // namespace

std::optional<ShaftAngle> ShaftAngle::of(const Recording& record) {
  ShaftAngle shaft;
  const Channel* angle = record.find(channel_names::input_angle);
  if (angle != nullptr && angle->samples.size() > 1) {
    if (!(angle->rate_Hz > 0)) return std::nullopt;
    shaft.is_measured_ = true;
    shaft.start_s_ = angle->start_s;
    shaft.step_s_ = 1 / angle->rate_Hz;
    shaft.turns_ = bridged_turns(*angle);
    if (shaft.turns_.size() < 2) return std::nullopt;
  } else if (std::isfinite(record.speed_rpm) && !record.channels.empty()) {
    const Channel& any = record.channels.front();
    if (!(any.rate_Hz > 0)) return std::nullopt;
    shaft.start_s_ = any.start_s;
    shaft.step_s_ = end_s(any) - any.start_s;
    shaft.turns_.resize(2);
    shaft.turns_ << 0, units::Hz_from_rpm(std::abs(record.speed_rpm)) * shaft.step_s_;
  } else {
    return std::nullopt;
  }
  if (shaft.turns_[shaft.turns_.size() - 1] < shaft.turns_[0]) shaft.turns_ = -shaft.turns_;
  const Eigen::Index n = shaft.turns_.size();
  const bool turns_back =
      (shaft.turns_.tail(n - 1).array() < shaft.turns_.head(n - 1).array()).any();
  if (turns_back || !(shaft.turns_[n - 1] > shaft.turns_[0])) return std::nullopt;
  shaft.turns_.array() -= shaft.turns_[0];
  return shaft;
}

double ShaftAngle::mean_speed_Hz() const {
  return turns_[turns_.size() - 1] / (step_s_ * static_cast<double>(turns_.size() - 1));
}

double ShaftAngle::turns_at(double time_s) const {
  const double place = (time_s - start_s_) / step_s_;
  const auto last = turns_.size() - 2;
  const auto i = std::clamp(static_cast<Eigen::Index>(std::floor(place)), Eigen::Index{0}, last);
  return turns_[i] + (turns_[i + 1] - turns_[i]) * (place - static_cast<double>(i));
}

double ShaftAngle::time_before(Eigen::Index after, double turns) const {
  after = std::clamp<Eigen::Index>(after, 1, turns_.size() - 1);
  const double rise = std::max(turns_[after] - turns_[after - 1], 1e-300);
  return start_s_ + step_s_ * (static_cast<double>(after - 1) + (turns - turns_[after - 1]) / rise);
}

double ShaftAngle::whole_periods(Eigen::Index count, double rate_Hz, double start_s,
                                 double period_turns) const {
  const double until_s = start_s + static_cast<double>(count) / rate_Hz;
  return std::floor((turns_at(until_s) - turns_at(start_s)) / period_turns + 1e-6);
}

Eigen::VectorXd ShaftAngle::resample(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                     double start_s, double period_turns,
                                     int samples_per_turn) const {
  const double periods = whole_periods(x.size(), rate_Hz, start_s, period_turns);
  if (!(periods >= 1)) return {};
  const double first = turns_at(start_s);
  const auto n = static_cast<Eigen::Index>(std::llround(periods * period_turns * samples_per_turn));
  Eigen::VectorXd even(n);
  Eigen::Index after = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double turns = first + static_cast<double>(i) / samples_per_turn;
    while (after < turns_.size() && turns_[after] <= turns) ++after;
    even[i] = at(x, (time_before(after, turns) - start_s) * rate_Hz);
  }
  return even;
}

}  // namespace rvbench::analysis
