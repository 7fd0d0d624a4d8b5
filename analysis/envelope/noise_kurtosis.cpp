#include "analysis/envelope/noise_kurtosis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double least_p = 1e-13;
constexpr int steps = 64;  // over the largest power; twice as many change the third digit at most

// Mean of w^j, j = 0..6, of exponential w below m.
std::array<double, 7> moments_below(double m) {
  std::array<double, 7> moments{1};
  const double inside = -std::expm1(-m);
  double edge = std::exp(-m) / inside;
  for (std::size_t j = 1; j < moments.size(); ++j) {
    edge *= m;
    moments[j] = double(j) * moments[j - 1] - edge;
  }
  return moments;
}

// Probability that a sum exceeds z standard deviations, by its skewness: a shifted gamma's.
double above(double z, double skewness) {
  constexpr double straight = 1e-3;
  if (std::abs(skewness) < straight) return 0.5 * std::erfc(z / std::sqrt(2.0));
  const double shape = 4 / (skewness * skewness);
  const double from_end = shape + (skewness > 0 ? z : -z) * std::sqrt(shape);
  if (from_end <= 0) return skewness > 0 ? 1 : 0;
  return skewness > 0 ? Eigen::numext::igammac(shape, from_end)
                      : Eigen::numext::igamma(shape, from_end);
}

// Probability that Σw² exceeds ratio/M·(Σw)² where the largest of M exponential w is m. To first
// order about its mean the sum of the others is Σ(w² - slope·w) against a number.
double above_given_largest(double m, double ratio, double samples) {
  const std::array<double, 7> w = moments_below(m);
  const double others = samples - 1;
  const double sum = others * w[1] + m;
  const double slope = 2 * ratio * sum / samples;
  const double needed =
      ratio / samples * (sum * sum + others * (w[2] - w[1] * w[1])) - m * m - others * w[2];
  const double first = w[2] - slope * w[1];
  const double second = w[4] - 2 * slope * w[3] + slope * slope * w[2];
  const double third =
      w[6] - 3 * slope * w[5] + 3 * slope * slope * w[4] - slope * slope * slope * w[3];
  const double variance = others * (second - first * first);
  if (!(variance > 0)) return needed < 0 ? 1 : 0;
  const double moment = others * (third - 3 * first * second + 2 * first * first * first);
  return above(needed / std::sqrt(variance), moment / std::pow(variance, 1.5));
}

}  // namespace

double complex_kurtosis(const Eigen::Ref<const Eigen::VectorXcd>& z) {
  if (z.size() == 0) return 0;
  const Eigen::ArrayXd power = z.array().abs2();
  const double mean = power.mean();
  return mean > 0 ? (power / mean).square().mean() - 2 : 0;
}

double noise_kurtosis_p_value(double kurtosis, double samples) {
  constexpr Require require{"noise_kurtosis_p_value"};
  require(std::isfinite(kurtosis), "the kurtosis is not finite");
  require(std::isfinite(samples) && samples >= 2, "needs at least 2 samples");
  // The largest of the powers is within these but for 1e-13 of all cases.
  const double least = -std::log(-std::expm1(-30 / samples));
  const double most = std::log(samples) + 30;
  const double step = (most - least) / steps;
  double p = 0;
  for (int i = 0; i < steps; ++i) {
    const double m = least + (i + 0.5) * step;
    const double density = samples * std::exp(-m + (samples - 1) * std::log1p(-std::exp(-m)));
    p += step * density * above_given_largest(m, kurtosis + 2, samples);
  }
  return std::clamp(p, least_p, 1.0);
}

double independent_samples(const Eigen::Ref<const Eigen::VectorXd>& power, double samples) {
  const Eigen::ArrayXd squares = fft(power).array().abs2();
  if (!(squares[0] > 0)) return samples;
  const Eigen::ArrayXd fourths = (squares / squares[0]).square();
  const Eigen::Index last = fourths.size() - 1;
  const bool has_middle = power.size() % 2 == 0 && last > 0;
  const double sum = 2 * fourths.sum() - fourths[0] - (has_middle ? fourths[last] : 0);
  return std::max(1.0, samples / sum);
}

}  // namespace rvbench::analysis
