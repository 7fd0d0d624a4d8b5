#include "analysis/order/order_lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double held = 0.4;  // of the record's rate
constexpr double fewest_per_turn = 32;
constexpr double per_highest = 8;  // samples per turn of a band's highest order
constexpr Eigen::Index fewest_turns = 4;

}  // namespace

OrderLines::OrderLines(const Channel& x, const ShaftAngle& angle, double period_turns)
    : mean_speed_Hz_(angle.mean_speed_Hz()), angle_is_measured_(angle.is_measured()) {
  Require{"OrderLines"}(x.samples.allFinite(), "a sample is not finite");
  const double per_turn_in_time = x.rate_Hz / mean_speed_Hz_;
  const double periods = angle.whole_periods(x.samples.size(), x.rate_Hz, x.start_s, period_turns);
  if (periods < 1) return;
  const double least = std::max(per_turn_in_time, fewest_per_turn);  // no wider: nothing folds
  samples_ = angle.resample(x.samples, x.rate_Hz, x.start_s, period_turns, least);
  mean_ = samples_.mean();
  samples_.array() -= mean_;
  turns_ = periods * period_turns;
  top_order_ = top_order_of(x.rate_Hz, angle);
  lines_ = fft(samples_);
  lines_[0] = 0;  // but for rounding
  const Eigen::Index n = lines_.size();
  spectrum_ = {1 / turns_, Eigen::VectorXd::Zero(n)};
  if (n < 3) return;
  const double scale = 2 / static_cast<double>(samples_.size());
  spectrum_.amplitude = scale * lines_under_hann(lines_, n).cwiseAbs2().cwiseSqrt();
  spectrum_.amplitude[0] = std::abs(mean_);
}

double OrderLines::top_order_of(double rate_Hz, const ShaftAngle& angle) {
  return held * rate_Hz / angle.mean_speed_Hz();
}

Eigen::VectorXd OrderLines::between(double from, double to) const {
  to = std::min(to, top_order_);
  const auto first = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil(from * turns_)));
  const auto end = std::min(lines_.size(), static_cast<Eigen::Index>(std::ceil(to * turns_)));
  if (first >= end) return {};
  const double wanted = std::min(per_highest * to * turns_, static_cast<double>(samples_.size()));
  const Eigen::Index n = next_fast_length(static_cast<Eigen::Index>(std::ceil(wanted)));
  Eigen::VectorXcd band = Eigen::VectorXcd::Zero(n / 2 + 1);
  const double scale = static_cast<double>(n) / static_cast<double>(samples_.size());
  band.segment(first, end - first) = scale * lines_.segment(first, end - first);
  return inverse_fft(std::move(band), n);
}

OrderLines::TurnLines OrderLines::turn_lines(double order) const {
  const auto turns = static_cast<Eigen::Index>(std::floor(order * turns_ + 1e-6));
  if (empty() || turns < fewest_turns) return {};
  const double share = static_cast<double>(turns) / (order * turns_);
  const auto whole =
      static_cast<Eigen::Index>(std::llround(share * static_cast<double>(samples_.size())));
  Eigen::VectorXcd cut;
  if (whole != samples_.size()) cut = fft(samples_.head(whole));
  const Eigen::VectorXcd& lines = whole == samples_.size() ? lines_ : cut;

  const Eigen::Index n = whole / turns;
  if (n < 4) return {};
  Eigen::VectorXcd kept = Eigen::VectorXcd::Zero(n / 2 + 1);
  const auto highest = static_cast<Eigen::Index>(top_order_ / order);
  const double scale = static_cast<double>(n) / static_cast<double>(whole);
  for (Eigen::Index h = 0; h <= std::min(highest, (n - 1) / 2); ++h) {
    kept[h] = scale * lines[h * turns];
  }
  return {std::move(kept), n};
}

Eigen::VectorXd OrderLines::average_turn(double order) const {
  TurnLines turn = turn_lines(order);
  if (turn.samples == 0) return {};
  return inverse_fft(std::move(turn.lines), turn.samples);
}

}  // namespace rvbench::analysis
