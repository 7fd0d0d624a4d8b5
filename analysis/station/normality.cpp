#include "analysis/station/normality.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/station/distributions.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index fewest = 8;
constexpr double least_p = 1e-6, least_share = 1e-300;

double p_of(double a2) {
  if (a2 >= 0.6) return std::exp(1.2937 - 5.709 * a2 + 0.0186 * a2 * a2);
  if (a2 >= 0.34) return std::exp(0.9177 - 4.279 * a2 - 1.38 * a2 * a2);
  if (a2 >= 0.2) return 1 - std::exp(-8.318 + 42.796 * a2 - 59.938 * a2 * a2);
  return 1 - std::exp(-13.436 + 101.14 * a2 - 223.73 * a2 * a2);
}

}  // namespace

double normality_p_value(const Eigen::Ref<const Eigen::VectorXd>& values) {
  constexpr Require require{"normality_p_value"};
  require(values.size() >= fewest && values.allFinite(), "fewer than 8 values, or one not finite");
  const auto n = double(values.size());
  Eigen::ArrayXd z = values.array() - values.mean();
  const double deviation = std::sqrt(z.square().sum() / (n - 1));
  if (!(deviation > 0)) return 0;
  z /= deviation;
  std::ranges::sort(z);
  double sum = 0;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const double below = normal_probability(z[i]), above = normal_probability(-z[z.size() - 1 - i]);
    sum += (2 * double(i) + 1) *
           (std::log(std::max(below, least_share)) + std::log(std::max(above, least_share)));
  }
  const double a2 = (-n - sum / n) * (1 + 0.75 / n + 2.25 / (n * n));
  // The fit turns up again beyond 13.
  return a2 > 13 ? least_p : std::clamp(p_of(a2), least_p, 1.0);
}

}  // namespace rvbench::analysis
