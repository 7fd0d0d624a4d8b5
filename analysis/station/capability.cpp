#include "analysis/station/capability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/station/distributions.hpp"
#include "analysis/station/normality.hpp"
#include "analysis/station/not_finite.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using std::numbers::pi;

// A standard deviation, and what it was taken from.
struct Spread {
  double sigma = 0, freedom = 0;
  double values = 0;
};

CapabilityIndex of_width(double width, const Spread& spread, double confidence) {
  const double index = width / (6 * spread.sigma), tail = (1 - confidence) / 2;
  const auto end = [&](double probability) {
    return index * std::sqrt(chi_square_quantile(probability, spread.freedom) / spread.freedom);
  };
  return {index, {end(tail), end(1 - tail)}};
}

CapabilityIndex of_nearer(double distance, const Spread& spread, double confidence) {
  const double index = distance / (3 * spread.sigma);
  const double error = std::sqrt(1 / (9 * spread.values) + index * index / (2 * spread.freedom));
  const double reach = normal_quantile((1 + confidence) / 2) * error;
  return {index, {index - reach, index + reach}};
}

bool is_finite(const CapabilityIndex& index) {
  return are_finite({index.value, index.interval.low, index.interval.high});
}

// Degrees of freedom of the variance that scatters, relatively, as the mean range's σ does: ranges
// of neighbours share a value, so that |x₁ - x₂| and |x₂ - x₃| are those of normals correlated by
// -1/2.
double freedom_of_mean_range(double n) {
  const double rho = -0.5, ranges = n - 1;
  const double mean_square = 4 / pi;  // of a range's mean; all in units of σ²
  const double product = 4 / pi * (std::sqrt(1 - rho * rho) + rho * std::asin(rho));
  const double sum = ranges * (2 - mean_square) + 2 * (ranges - 1) * (product - mean_square);
  return 0.5 * ranges * ranges * mean_square / sum;
}

}  // namespace

std::variant<Capability, std::string> capability_of(const Eigen::Ref<const Eigen::VectorXd>& values,
                                                    const SpecificationLimits& limits,
                                                    double confidence) {
  constexpr Require require{"capability_of"};
  const auto made = baseline_of(values);
  if (const auto* why = std::get_if<std::string>(&made)) return *why;
  const auto& baseline = std::get<ChartBaseline>(made);
  require(baseline.sigma > 0, "all values are alike");
  require(limits.lower || limits.upper, "no limit");
  require(!limits.lower || !limits.upper || *limits.lower < *limits.upper,
          "the lower limit is not below the upper one");
  require(confidence > 0 && confidence < 1, "the confidence is a share between 0 and 1");
  const auto n = double(values.size());
  const double all = std::sqrt((values.array() - baseline.centre).square().sum() / (n - 1));
  if (!are_finite({all})) return not_finite("the standard deviation");
  const Spread within{baseline.sigma, freedom_of_mean_range(n), n}, overall{all, n - 1, n};

  constexpr double none = std::numeric_limits<double>::infinity();
  const double nearer = std::min(limits.upper ? *limits.upper - baseline.centre : none,
                                 limits.lower ? baseline.centre - *limits.lower : none);
  Capability capability;
  capability.cpk = of_nearer(nearer, within, confidence);
  capability.ppk = of_nearer(nearer, overall, confidence);
  if (limits.lower && limits.upper) {
    const double width = *limits.upper - *limits.lower;
    capability.cp = of_width(width, within, confidence);
    capability.pp = of_width(width, overall, confidence);
  }
  const bool are_told =
      is_finite(capability.cpk) && is_finite(capability.ppk) &&
      (!capability.cp || (is_finite(*capability.cp) && is_finite(*capability.pp)));
  if (!are_told) return not_finite("an index");
  capability.normality_p = normality_p_value(values);
  return capability;
}

}  // namespace rvbench::analysis
