#include "sim/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace rvbench::sim {
namespace {

using std::numbers::pi;

constexpr double periods = 4;          // of the cut-off on each side: 70 dB from 1.4 times it on
constexpr Eigen::Index shortest = 16;  // samples on each side: flat to 0.1 % up to 0.4 of the rate

struct Jet {
  double value, first, second;
};

// sin(ωt)/(πt) and its derivatives.
Jet low_pass(double t, double omega) {
  const double x = omega * t;
  if (std::abs(x) < 1e-3) {
    return {omega / pi * (1 - x * x / 6), -omega * omega / pi * x / 3,
            -omega * omega * omega / (3 * pi)};
  }
  const double s = std::sin(x), c = std::cos(x);
  const double value = s / (pi * t);
  const double first = (omega * c - s / t) / (pi * t);
  return {value, first, -omega * omega * value - 2 * first / t};
}

// Blackman's window over |t| < width.
Jet window(double t, double width) {
  if (std::abs(t) >= width) return {0, 0, 0};
  const double w = pi / width;
  return {0.42 + 0.5 * std::cos(w * t) + 0.08 * std::cos(2 * w * t),
          -w * (0.5 * std::sin(w * t) + 0.16 * std::sin(2 * w * t)),
          -w * w * (0.5 * std::cos(w * t) + 0.32 * std::cos(2 * w * t))};
}

Eigen::VectorXd weights(int derivative, const Eigen::VectorXd& t, double omega, double width) {
  Eigen::VectorXd h(t.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const Jet a = low_pass(t[i], omega), b = window(t[i], width);
    h[i] = derivative == 0   ? a.value * b.value
           : derivative == 1 ? a.first * b.value + a.value * b.first
                             : a.second * b.value + 2 * a.first * b.first + a.value * b.second;
  }
  return h;
}

}  // namespace

Interpolation::Interpolation(int derivative, double fraction, double cutoff) {
  if (derivative < 0 || derivative > 2 || !(fraction >= 0 && fraction < 1) ||
      !(cutoff > 0 && cutoff <= 0.5)) {
    throw std::invalid_argument(
        "Interpolation: derivative must be 0..2, fraction within [0, 1), cutoff within (0, 0.5]");
  }
  const double width = std::max(double(shortest), periods / cutoff);
  const double omega = 2 * pi * cutoff;
  reach_ = static_cast<Eigen::Index>(std::ceil(width));
  // t: from sample to the place sought. x(place) = Σ h(t)·x.
  const Eigen::VectorXd t =
      fraction -
      Eigen::VectorXd::LinSpaced(2 * reach_ + 1, double(-reach_), double(reach_)).array();
  const Eigen::VectorXd plain = weights(0, t, omega, width);
  weights_ = plain / plain.sum();
  if (derivative == 0) return;
  // A constant has no slope, a straight line the slope 1.
  const Eigen::VectorXd smooth = weights_;
  weights_ = weights(1, t, omega, width);
  weights_ -= weights_.sum() * smooth;
  weights_ /= -weights_.dot(t);
  if (derivative == 1) return;
  const Eigen::VectorXd slope = weights_;
  weights_ = weights(2, t, omega, width);
  weights_ -= weights_.sum() * smooth;
  weights_ += weights_.dot(t) * slope;
  weights_ *= 2 / weights_.dot(t.cwiseAbs2());
}

double Interpolation::operator()(const Eigen::VectorXd& x, Eigen::Index at) const {
  const Eigen::Index first = at - reach_, last = x.size() - 1;
  if (first >= 0 && at + reach_ <= last) return weights_.dot(x.segment(first, weights_.size()));
  double sum = 0;
  for (Eigen::Index j = 0; j < weights_.size(); ++j) {
    const Eigen::Index i = first + j;
    const Eigen::Index inside = std::clamp(i < 0      ? -i
                                           : i > last ? 2 * last - i
                                                      : i,
                                           Eigen::Index{0}, last);
    const double value = i < 0 ? 2 * x[0] - x[inside] : i > last ? 2 * x[last] - x[inside] : x[i];
    sum += weights_[j] * value;
  }
  return sum;
}

}  // namespace rvbench::sim
