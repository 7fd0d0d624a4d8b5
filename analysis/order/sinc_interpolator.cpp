#include "analysis/order/sinc_interpolator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/order/sinc_kernels.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index phases = 256;  // tabulated between two samples, straight lines between them
constexpr Eigen::Index profile_phases = 1024;

}  // namespace

SincInterpolator::SincInterpolator(Eigen::Index taps, double kaiser_beta)
    : taps_(taps),
      kaiser_beta_(kaiser_beta),
      kernel_(taps, phases + 1),
      profile_(taps / 2 * profile_phases + 2) {
  constexpr Require require{"SincInterpolator"};
  require(taps >= 4 && taps % 2 == 0, "taps must be even, and at least 4");
  require(kaiser_beta >= 0, "kaiser_beta must not be below 0");
  for (Eigen::Index phase = 0; phase <= phases; ++phase) {
    for (Eigen::Index tap = 0; tap < taps; ++tap) {
      kernel_(tap, phase) = shape(static_cast<double>(phase) / phases -
                                  static_cast<double>(tap + 1) + static_cast<double>(taps) / 2);
    }
    kernel_.col(phase) /= kernel_.col(phase).sum();
  }
  for (Eigen::Index i = 0; i < profile_.size(); ++i) {
    profile_[i] = shape(static_cast<double>(i) / profile_phases);
  }
}

double SincInterpolator::shape(double away) const {
  const double x = std::numbers::pi * away;
  const double sinc = std::abs(x) < 1e-12 ? 1 : std::sin(x) / x;
  const double edge = std::min(1.0, std::abs(away) * 2 / static_cast<double>(taps_));
  return sinc * std::cyl_bessel_i(0, kaiser_beta_ * std::sqrt(1 - edge * edge));
}

double SincInterpolator::at(const Eigen::Ref<const Eigen::VectorXd>& x, double place) const {
  const Eigen::Index last = x.size() - 1;
  const auto i = std::clamp(static_cast<Eigen::Index>(place), Eigen::Index{0}, last);
  const double phase = std::clamp(place - static_cast<double>(i), 0.0, 1.0) * phases;
  const auto below = std::min(static_cast<Eigen::Index>(phase), phases - 1);
  const double weight = phase - static_cast<double>(below);
  const Eigen::Index first = i - taps_ / 2 + 1;
  if (first >= 0 && first + taps_ <= x.size()) {
    return sinc_kernels().between(x.data() + first, kernel_.col(below).data(),
                                  kernel_.col(below + 1).data(), weight, taps_);
  }
  double sum = 0;
  for (Eigen::Index tap = 0; tap < taps_; ++tap) {
    sum += ((1 - weight) * kernel_(tap, below) + weight * kernel_(tap, below + 1)) *
           x[std::clamp(first + tap, Eigen::Index{0}, last)];
  }
  return sum;
}

double SincInterpolator::at(const Eigen::Ref<const Eigen::VectorXd>& x, double place,
                            double cut) const {
  if (cut >= 1) return at(x, place);
  const Eigen::Index last = x.size() - 1;
  const double reach = static_cast<double>(taps_) / 2 / cut;
  const auto from = static_cast<Eigen::Index>(std::ceil(place - reach));
  const auto to = static_cast<Eigen::Index>(std::floor(place + reach));
  double sum = 0, weights = 0;
  for (Eigen::Index i = from; i <= to; ++i) {
    const double away = std::abs(static_cast<double>(i) - place) * cut * profile_phases;
    const auto below = std::min(static_cast<Eigen::Index>(away), profile_.size() - 2);
    const double t = away - static_cast<double>(below);
    const double weight = profile_[below] + t * (profile_[below + 1] - profile_[below]);
    sum += weight * x[std::clamp(i, Eigen::Index{0}, last)];
    weights += weight;
  }
  return sum / weights;
}

}  // namespace rvbench::analysis
