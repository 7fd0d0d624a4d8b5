#include "analysis/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/SpecialFunctions>
#include <utility>

namespace rvbench::analysis {

double median(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("median: no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double variance_of_median(const std::vector<double>& variances) {
  return std::numbers::pi / 2 * median(variances) / static_cast<double>(variances.size());
}

double median_near(double guess, std::vector<double> values) {
  const double from = guess / 1.5, to = guess * 1.5;
  std::vector<double> near(values.size() + 1);
  std::size_t below = 0, kept = 0;
  for (const double value : values) {  // no branch: which way it went could not be predicted
    near[kept] = value;
    kept += static_cast<std::size_t>(value >= from && value <= to);
    below += static_cast<std::size_t>(value < from);
  }
  const std::size_t middle = values.size() / 2;
  const bool is_among_them = below < middle && middle < below + kept;  // and the one before it
  if (!is_among_them) return median(std::move(values));
  near.resize(kept);
  const auto at = near.begin() + static_cast<std::ptrdiff_t>(middle - below);
  std::nth_element(near.begin(), at, near.end());
  if (values.size() % 2 == 1) return *at;
  return 0.5 * (*at + *std::max_element(near.begin(), at));
}

double correlation(const Eigen::Ref<const Eigen::VectorXd>& a,
                   const Eigen::Ref<const Eigen::VectorXd>& b) {
  const Eigen::ArrayXd da = a.array() - a.mean();
  const Eigen::ArrayXd db = b.array() - b.mean();
  const double spread = std::sqrt(da.square().sum() * db.square().sum());
  return spread > 0 ? (da * db).sum() / spread : 0;
}

double kurtosis(const Eigen::Ref<const Eigen::VectorXd>& x) {
  const Eigen::ArrayXd d2 = (x.array() - x.mean()).square();
  const double variance = d2.mean();
  return variance > 0 ? d2.square().mean() / (variance * variance) : 0;
}

double line_p_value(double statistic, double lines, double floor_lines) {
  if (!(statistic > 0)) return 1;
  return Eigen::numext::betainc(floor_lines, lines, floor_lines / (floor_lines + statistic));
}

double t_p_value(double t, double freedom) {
  return Eigen::numext::betainc(freedom / 2, 0.5, freedom / (freedom + t * t));
}

double t_of_p_value(double p, double freedom) {
  if (!(p > 0 && p < 1) || !(freedom >= 1)) throw std::invalid_argument("t_of_p_value: p, freedom");
  double low = 0, high = 1;
  while (t_p_value(high, freedom) > p) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (t_p_value(middle, freedom) > p ? low : high) = middle;
  }
  return high;
}

double combined_p_value(const std::vector<double>& p_values) {
  if (p_values.empty()) return 1;
  double sum = 0;
  for (const double p : p_values) sum -= std::log(std::clamp(p, 1e-300, 1.0));
  if (sum == 0) return 1;
  return Eigen::numext::igammac(static_cast<double>(p_values.size()), sum);
}

double minus_log_gamma_tail(double sum, int count) {
  double term = 1, total = 1;  // of the series, over its last term
  for (int k = count - 1; k > 0; --k) {
    term *= k / sum;
    total += term;
  }
  return sum - (count - 1) * std::log(sum) + std::lgamma(count) - std::log(total);
}

}  // namespace rvbench::analysis
