#include "bench/report/order_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

/// Linear interpolation of uniform samples at a fractional index; the ends are held.
double value_at(const Eigen::VectorXd& samples, double index) {
  const double held = std::clamp(index, 0.0, double(samples.size() - 1));
  const auto left = std::min<Eigen::Index>(static_cast<Eigen::Index>(held), samples.size() - 2);
  const double share = held - double(left);
  return (1 - share) * samples[left] + share * samples[left + 1];
}

/// Turns of the shaft since the first sample, at the times of `like`; rising.
Eigen::VectorXd turns_at(const Channel& like, const Channel& angle) {
  Eigen::VectorXd turns(like.samples.size());
  for (Eigen::Index i = 0; i < turns.size(); ++i) {
    const double time_s = like.start_s + double(i) / like.rate_Hz;
    turns[i] = value_at(angle.samples, (time_s - angle.start_s) * angle.rate_Hz) / units::two_pi;
  }
  const double sign = turns[turns.size() - 1] < turns[0] ? -1 : 1;
  const double start = turns[0];
  return sign * (turns.array() - start);
}

/// x at equal steps of angle, as many as there were in time: the band of x keeps its room.
Eigen::VectorXd resampled(const Eigen::VectorXd& x, const Eigen::VectorXd& turns) {
  Eigen::VectorXd even(x.size());
  const double step = turns[turns.size() - 1] / double(x.size() - 1);
  Eigen::Index left = 0;
  for (Eigen::Index i = 0; i < even.size(); ++i) {
    const double wanted = double(i) * step;
    while (left + 2 < turns.size() && turns[left + 1] < wanted) ++left;
    const double width = turns[left + 1] - turns[left];
    const double share = width > 0 ? (wanted - turns[left]) / width : 0;
    even[i] = value_at(x, double(left) + share);
  }
  return even;
}

}  // namespace

analysis::Spectrum order_spectrum(const Eigen::VectorXd& x, const Channel& like,
                                  const Recording& recording) {
  const Eigen::VectorXd centred = x.array() - x.mean();
  const Channel* angle = recording.find(channel_names::input_angle);
  if (angle != nullptr && angle->samples.size() > 1 && angle->samples.allFinite()) {
    const Eigen::VectorXd turns = turns_at(like, *angle);
    const double total_turns = turns[turns.size() - 1];
    if (total_turns > 1) {
      const double per_turn = double(x.size() - 1) / total_turns;
      return analysis::amplitude_spectrum(resampled(centred, turns), per_turn,
                                          analysis::Window::hann);
    }
  }
  if (!(std::abs(recording.speed_rpm) > 0)) {
    throw std::invalid_argument("order_spectrum: neither shaft angle nor speed of " +
                                recording.source + " is known");
  }
  const double turns_per_s = units::Hz_from_rpm(std::abs(recording.speed_rpm));
  return analysis::amplitude_spectrum(centred, like.rate_Hz / turns_per_s, analysis::Window::hann);
}

}  // namespace rvbench::bench
