#include "analysis/compare/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unsupported/Eigen/SpecialFunctions>

namespace rvbench::analysis {
namespace {

constexpr std::size_t fewest = 10;
constexpr double sure = 2;  // standard errors: once in forty they are of more kinds than that

double digamma(double x) { return Eigen::numext::digamma(x); }
double trigamma(double x) { return Eigen::numext::zeta(2.0, x); }

// The x whose trigamma is y: it falls from infinity at 0 to 0.
double inverse_trigamma(double y) {
  double low = 1e-8, high = 1e8;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (trigamma(middle) > y ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double sum_of_squares(const std::vector<double>& x) {
  if (x.empty()) return 0;
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  double sum = 0;
  for (const double v : x) sum += (v - mean) * (v - mean);
  return sum;
}

bool is_usable(const Scatter& s) { return s.freedom > 0 && s.variance > 0; }

// What all estimates say: s₀² and the least d₀ that they allow; d₀ 0 if they say nothing.
Scatter prior_of(const std::vector<Scatter>& estimates) {
  std::vector<double> logs;
  double chance = 0;  // mean variance of the logarithms if all were estimates of one
  for (const Scatter& s : estimates) {
    if (!is_usable(s)) continue;
    logs.push_back(std::log(s.variance) - digamma(s.freedom / 2) + std::log(s.freedom / 2));
    chance += trigamma(s.freedom / 2);
  }
  if (logs.size() < fewest) return {};
  const double count = static_cast<double>(logs.size());
  const double mean = std::accumulate(logs.begin(), logs.end(), 0.0) / count;
  const double variance = sum_of_squares(logs) / (count - 1);
  const double error = variance * std::sqrt(2 / (count - 1));  // of a Gaussian's variance
  const double beyond = variance + sure * error - chance / count;
  if (beyond <= 0) return {std::exp(mean), std::numeric_limits<double>::infinity()};
  const double half = inverse_trigamma(beyond);
  return {std::exp(mean + digamma(half) - std::log(half)), 2 * half};
}

}  // namespace

Scatter pooled_scatter(const std::vector<double>& a, const std::vector<double>& b) {
  const auto freedom_of = [](const std::vector<double>& x) {
    return x.empty() ? 0.0 : static_cast<double>(x.size() - 1);
  };
  const double freedom = freedom_of(a) + freedom_of(b);
  return {freedom > 0 ? (sum_of_squares(a) + sum_of_squares(b)) / freedom : 0, freedom};
}

std::vector<Scatter> drawn_together(std::vector<Scatter> estimates) {
  const Scatter prior = prior_of(estimates);
  if (!(prior.freedom > 0)) return estimates;
  double all = 0;
  for (const Scatter& s : estimates) all += s.freedom;
  const double weight = std::min(prior.freedom, all);
  for (Scatter& s : estimates) {
    if (!(s.freedom > 0) || s.freedom > prior.freedom) continue;
    s.variance = (weight * prior.variance + s.freedom * s.variance) / (weight + s.freedom);
    s.freedom = std::min(weight + s.freedom, all);
  }
  return estimates;
}

}  // namespace rvbench::analysis
