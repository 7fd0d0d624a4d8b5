#include "bench/benchmarks/gear_signal.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace rvbench::bench {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// A strike every `period_s`, give or take 1 %, each ringing down within a few milliseconds.
void add_strikes(Eigen::VectorXd& x, double period_s, std::mt19937_64& generator) {
  constexpr double resonance_Hz = 1480, decay_1_s = 900, height = 0.9;
  constexpr Eigen::Index length = 64;
  std::normal_distribution<double> jitter(1, 0.01);
  double struck_s = period_s;
  while (true) {
    const auto first = static_cast<Eigen::Index>(std::ceil(struck_s * gear_signal_rate_Hz));
    if (first + length > x.size()) return;
    for (Eigen::Index i = first; i < first + length; ++i) {
      const double t = static_cast<double>(i) / gear_signal_rate_Hz - struck_s;
      x[i] += height * std::exp(-decay_1_s * t) * std::sin(two_pi * resonance_Hz * t);
    }
    struck_s += period_s * jitter(generator);
  }
}

}  // namespace

Eigen::VectorXd gear_signal(double duration_s) {
  const auto n = static_cast<Eigen::Index>(std::lround(duration_s * gear_signal_rate_Hz));
  const Eigen::ArrayXd t =
      Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1)) / gear_signal_rate_Hz;
  const auto tone = [&](double frequency_Hz) { return (two_pi * frequency_Hz * t).cos().eval(); };
  constexpr double shaft_Hz = 30.25, output_Hz = shaft_Hz / 121;

  Eigen::VectorXd x = 0.5 * tone(shaft_Hz) + 0.4 * tone(output_Hz) + 0.05 * tone(0.01);
  const double mesh[] = {1, 0.55, 0.32, 0.18}, pins[] = {0.6, 0.3, 0.15};
  const Eigen::ArrayXd shaft_swing = 1 + 0.35 * tone(shaft_Hz) + 0.2 * tone(output_Hz);
  const Eigen::ArrayXd output_swing = 1 + 0.5 * tone(output_Hz);
  double harmonic = 0;
  for (const double a : mesh) x.array() += a * shaft_swing * tone(1080 * output_Hz * ++harmonic);
  harmonic = 0;
  for (const double a : pins) x.array() += a * output_swing * tone(1560 * output_Hz * ++harmonic);

  std::mt19937_64 generator(20240607);
  add_strikes(x, 1 / 52.37, generator);
  std::normal_distribution<double> noise(0, 0.25);
  for (double& sample : x) sample += noise(generator);
  return x;
}

}  // namespace rvbench::bench
