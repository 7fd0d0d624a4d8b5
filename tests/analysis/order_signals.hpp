#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "analysis/shaft_angle.hpp"
#include "hal/types/recording.hpp"
#include "tests/support/signals.hpp"

namespace rvbench::test {

/// A shaft that turns evenly, and what is heard over it.
struct OrderSignals {
  double speed_Hz = 20;
  double rate_Hz = 2000;
  Eigen::Index count = 20000;

  /// cos(2π·order·turns + phase)
  Eigen::VectorXd tone(double order, double phase_rad = 0) const {
    return test::tone(order * speed_Hz, count, rate_Hz, phase_rad);
  }

  /// A carrier whose amplitude swings by `depth` at `order`.
  Eigen::VectorXd modulated(double carrier, double order, double depth) const {
    return (1 + depth * tone(order, 0.4).array()) * tone(carrier).array();
  }

  Eigen::VectorXd noise(unsigned seed) const { return white_noise(count, seed); }

  Channel channel(Eigen::VectorXd samples, const char* name = "accel_1x") const {
    return {{name, "m/s²", "+X", not_known}, rate_Hz, 0, std::move(samples)};
  }

  /// One acceleration channel, and the shaft's angle as an encoder gives it.
  Recording recording(Eigen::VectorXd samples) const {
    Recording record;
    record.source = "synthetic";
    record.speed_rpm = speed_Hz * 60;
    record.channels = {channel(std::move(samples)), angle_channel()};
    return record;
  }

  Channel angle_channel() const {
    constexpr double angle_rate_Hz = 100;
    const auto n =
        static_cast<Eigen::Index>(static_cast<double>(count) / rate_Hz * angle_rate_Hz + 1);
    const Eigen::VectorXd angle_rad = 2 * std::numbers::pi * speed_Hz * times_s(n, angle_rate_Hz);
    return {{"input_angle", "rad", "", not_known}, angle_rate_Hz, 0, angle_rad};
  }

  analysis::ShaftAngle angle() const {
    return *analysis::ShaftAngle::of(recording(Eigen::VectorXd::Zero(count)));
  }
};

/// Noise with the memory of one pole: x[i] = a·x[i − 1] + white.
inline Eigen::VectorXd reddened(Eigen::VectorXd white, double a) {
  for (Eigen::Index i = 1; i < white.size(); ++i) white[i] += a * white[i - 1];
  return white;
}

/// Noise through a resonance at frequency/rate with a damping ratio.
inline Eigen::VectorXd resonant(Eigen::VectorXd white, double relative_frequency, double damping) {
  const double w_rad = 2 * std::numbers::pi * relative_frequency;
  const double decay = std::exp(-w_rad * damping);
  for (Eigen::Index i = 2; i < white.size(); ++i) {
    white[i] += 2 * decay * std::cos(w_rad) * white[i - 1] - decay * decay * white[i - 2];
  }
  return white;
}

}  // namespace rvbench::test
