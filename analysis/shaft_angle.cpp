#include "analysis/shaft_angle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "analysis/fft.hpp"
#include "analysis/order/sinc_interpolator.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

// 60 dB: passes 0.44 of the rate, stops from 0.56 on.
const SincInterpolator& interpolator() {
  static const SincInterpolator sinc(32, 5.65);
  return sinc;
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

// An encoder's noise is white, what a shaft does is not: only lines well above it are kept. The
// slowest are, whatever they are: a shaft that gains speed has them all.
Eigen::VectorXd without_noise(const Eigen::VectorXd& turns) {
  constexpr Eigen::Index fewest = 256, slowest = 16;
  constexpr double stands_out = 12;  // noise is there once in 160 000 lines
  const Eigen::Index n = turns.size();
  if (n < fewest) return turns;
  const Eigen::VectorXd trend = Eigen::VectorXd::LinSpaced(n, turns[0], turns[n - 1]);
  Eigen::VectorXcd lines = fft(turns - trend);
  const Eigen::VectorXd power = lines.cwiseAbs2();
  const Eigen::Index quarter = power.size() / 4;
  const auto fast = power.segment(2 * quarter, quarter), fastest = power.tail(quarter);
  const double noise = median({fast.begin(), fast.end()}) / std::numbers::ln2;
  // The lines of a curve that is not closed fall with the fourth power of frequency; noise is flat.
  constexpr double flat = 0.7;
  if (median({fastest.begin(), fastest.end()}) / std::numbers::ln2 < flat * noise) return turns;
  for (Eigen::Index i = slowest; i < lines.size(); ++i) {
    if (power[i] < stands_out * noise) lines[i] = 0;
  }
  return trend + inverse_fft(std::move(lines), n);
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
    shaft.turns_ = without_noise(shaft.turns_);
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
  if (!shaft.straighten()) return std::nullopt;
  return shaft;
}

std::optional<ShaftAngle> ShaftAngle::of_turns(Eigen::VectorXd turns, double start_s,
                                               double step_s) {
  if (turns.size() < 2 || !turns.allFinite() || !(step_s > 0)) return std::nullopt;
  ShaftAngle shaft;
  shaft.is_measured_ = true;
  shaft.start_s_ = start_s;
  shaft.step_s_ = step_s;
  shaft.turns_ = std::move(turns);
  if (!shaft.straighten()) return std::nullopt;
  return shaft;
}

bool ShaftAngle::straighten() {
  const Eigen::Index n = turns_.size();
  if (turns_[n - 1] < turns_[0]) turns_ = -turns_;
  if (!(turns_[n - 1] > turns_[0])) return false;
  const bool turns_back = (turns_.tail(n - 1).array() < turns_.head(n - 1).array()).any();
  if (turns_back) return false;
  turns_.array() -= turns_[0];
  return true;
}

ShaftAngle ShaftAngle::geared(double ratio) const {
  if (!(ratio > 0)) throw std::invalid_argument("ShaftAngle::geared: ratio must be > 0");
  ShaftAngle other = *this;
  other.turns_ *= ratio;
  return other;
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

Eigen::VectorXd ShaftAngle::times_s(double first_turns, double samples_per_turn,
                                    Eigen::Index count) const {
  Eigen::VectorXd times_s(count);
  Eigen::Index after = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double turns = first_turns + static_cast<double>(i) / samples_per_turn;
    while (after < turns_.size() && turns_[after] <= turns) ++after;
    times_s[i] = time_before(after, turns);
  }
  return times_s;
}

double ShaftAngle::whole_periods(Eigen::Index count, double rate_Hz, double start_s,
                                 double period_turns) const {
  const double until_s = start_s + static_cast<double>(count) / rate_Hz;
  return std::floor((turns_at(until_s) - turns_at(start_s)) / period_turns + 1e-6);
}

Eigen::VectorXd ShaftAngle::resample(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                     double start_s, double period_turns,
                                     double least_per_turn) const {
  const double periods = whole_periods(x.size(), rate_Hz, start_s, period_turns);
  if (!(periods >= 1)) return {};
  const double first = turns_at(start_s);
  const double turns = periods * period_turns;
  const auto least = static_cast<Eigen::Index>(std::ceil(turns * least_per_turn - 1e-6));
  const Eigen::Index n = next_fast_length(std::max<Eigen::Index>(least, 1));
  Eigen::VectorXd even = times_s(first, static_cast<double>(n) / turns, n);
  for (double& sample : even) sample = interpolator().at(x, (sample - start_s) * rate_Hz);
  return even;
}

}  // namespace rvbench::analysis
