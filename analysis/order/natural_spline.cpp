#include "analysis/order/natural_spline.hpp"

#include <algorithm>
#include <utility>

#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

// Second derivatives at the points, 0 at both ends: a tridiagonal system, by elimination.
Eigen::VectorXd bends_of(const Eigen::VectorXd& at, const Eigen::VectorXd& values) {
  const Eigen::Index n = at.size();
  Eigen::VectorXd bends = Eigen::VectorXd::Zero(n), above = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const double before = at[i] - at[i - 1], after = at[i + 1] - at[i];
    const double kink = (values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before;
    const double pivot = 2 * (before + after) - before * above[i - 1];
    above[i] = after / pivot;
    bends[i] = (6 * kink - before * bends[i - 1]) / pivot;
  }
  for (Eigen::Index i = n - 2; i > 0; --i) bends[i] -= above[i] * bends[i + 1];
  return bends;
}

}  // namespace

NaturalSpline::NaturalSpline(Eigen::VectorXd at, Eigen::VectorXd values)
    : at_(std::move(at)), values_(std::move(values)) {
  constexpr Require require{"NaturalSpline"};
  const Eigen::Index n = at_.size();
  require(n >= 2 && values_.size() == n, "needs at least two points, and a value for each");
  require(at_.allFinite() && values_.allFinite(), "a point is not finite");
  require((at_.tail(n - 1).array() > at_.head(n - 1).array()).all(), "points must rise");
  bends_ = bends_of(at_, values_);
  sums_ = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    sums_[i + 1] = sums_[i] + integral_over(i, at_[i + 1] - at_[i]);
  }
}

Eigen::Index NaturalSpline::piece_of(double where) const {
  const auto after = std::upper_bound(at_.begin(), at_.end(), where) - at_.begin();
  return std::clamp<Eigen::Index>(after - 1, 0, at_.size() - 2);
}

double NaturalSpline::operator()(double where) const {
  const Eigen::Index i = piece_of(where);
  const double h = at_[i + 1] - at_[i], t = where - at_[i];
  const double slope = (values_[i + 1] - values_[i]) / h - h * (2 * bends_[i] + bends_[i + 1]) / 6;
  if (t < 0) return values_[i] + slope * t;
  if (t > h) {
    const double end_slope = slope + h * (bends_[i] + bends_[i + 1]) / 2;
    return values_[i + 1] + end_slope * (t - h);
  }
  return values_[i] + t * (slope + t * (bends_[i] / 2 + t * (bends_[i + 1] - bends_[i]) / (6 * h)));
}

double NaturalSpline::integral_over(Eigen::Index i, double t) const {
  const double h = at_[i + 1] - at_[i];
  const double slope = (values_[i + 1] - values_[i]) / h - h * (2 * bends_[i] + bends_[i + 1]) / 6;
  return t * (values_[i] +
              t * (slope / 2 + t * (bends_[i] / 6 + t * (bends_[i + 1] - bends_[i]) / (24 * h))));
}

double NaturalSpline::integral(double where) const {
  const Eigen::Index i = piece_of(where);
  const double h = at_[i + 1] - at_[i], t = where - at_[i];
  if (t < 0) return t * (values_[0] + (*this)(where)) / 2;
  if (t > h) return sums_[i + 1] + (t - h) * (values_[i + 1] + (*this)(where)) / 2;
  return sums_[i] + integral_over(i, t);
}

}  // namespace rvbench::analysis
