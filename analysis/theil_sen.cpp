#include "analysis/theil_sen.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double z_95 = 1.959964;       // of the standard normal distribution, two-sided
constexpr double z_one_sided = 1.6449;  // 5 %, one-sided

void check(const std::vector<double>& x, const std::vector<double>& y) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("theil_sen: " + what);
  };
  if (x.size() != y.size()) refuse("x and y of two lengths");
  if (x.size() < fewest_for_slope || x.size() > most_for_slope) {
    refuse(std::to_string(x.size()) + " values");
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) refuse("a value is not finite");
    if (i > 0 && x[i] < x[i - 1]) refuse("x falls");
  }
  if (x.front() == x.back()) refuse("x is all alike");
}

std::vector<double> sorted_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = i + 1; j < x.size(); ++j) {
      if (x[j] > x[i]) slopes.push_back((y[j] - y[i]) / (x[j] - x[i]));
    }
  }
  std::ranges::sort(slopes);
  return slopes;
}

// Σ t(t − 1)(2t + 5) over groups of t equal values.
double tie_term(std::vector<double> values) {
  std::ranges::sort(values);
  double sum = 0;
  for (auto first = values.begin(); first != values.end();) {
    const auto last = std::upper_bound(first, values.end(), *first);
    const auto t = double(last - first);
    sum += t * (t - 1) * (2 * t + 5);
    first = last;
  }
  return sum;
}

// By what the variance of a sum over values with that lag-1 correlation is larger.
double widening(const std::vector<double>& residuals) {
  const auto n = double(residuals.size());
  double mean = 0;
  for (const double e : residuals) mean += e / n;
  double power = 0, product = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    power += (residuals[i] - mean) * (residuals[i] - mean);
    if (i > 0) product += (residuals[i] - mean) * (residuals[i - 1] - mean);
  }
  const double r = power > 0 ? product / power : 0;
  if (r * std::sqrt(n) < z_one_sided) return 1;
  double sum = 0, r_k = 1;
  for (double k = 1; k < n; ++k) {
    r_k *= r;
    sum += (1 - k / n) * r_k;
  }
  return 1 + 2 * sum;
}

}  // namespace

SlopeOverTime theil_sen(const std::vector<double>& x, const std::vector<double>& y) {
  check(x, y);
  const std::vector<double> slopes = sorted_slopes(x, y);
  const auto count = slopes.size();
  SlopeOverTime line;
  line.slope = count % 2 == 1 ? slopes[count / 2] : (slopes[count / 2 - 1] + slopes[count / 2]) / 2;
  const double middle_x = median(x), middle_y = median(y);
  line.level = middle_y;
  std::vector<double> residuals(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    residuals[i] = y[i] - middle_y - line.slope * (x[i] - middle_x);
  }
  line.dependence = widening(residuals);
  const auto n = double(x.size());
  const double variance =
      std::fmax(0, n * (n - 1) * (2 * n + 5) - tie_term(x) - tie_term(y)) / 18 * line.dependence;
  // Ranks, counted from 1, of the slopes that bound the interval.
  const double half = z_95 * std::sqrt(variance);
  const auto slope_at = [&](double rank) {
    return slopes[std::size_t(std::clamp(rank, 1.0, double(count))) - 1];
  };
  line.low = slope_at(std::floor((double(count) - half) / 2));
  line.high = slope_at(std::ceil((double(count) + half) / 2) + 1);
  return line;
}

}  // namespace rvbench::analysis
