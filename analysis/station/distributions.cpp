#include "analysis/station/distributions.hpp"

#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

#include "analysis/station/rising_root.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double beyond_all = 40;  // standard deviations

bool is_probability(double p) { return p > 0 && p < 1; }

}  // namespace

double normal_probability(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

double normal_quantile(double probability) {
  constexpr Require require{"normal_quantile"};
  require(is_probability(probability), "a probability is between 0 and 1");
  return rising_root(normal_probability, probability, -beyond_all, beyond_all);
}

double chi_square_probability(double x, double freedom) {
  return x > 0 ? Eigen::numext::igamma(freedom / 2, x / 2) : 0;
}

double chi_square_quantile(double probability, double freedom) {
  constexpr Require require{"chi_square_quantile"};
  require(is_probability(probability) && freedom > 0, "probability or freedom out of range");
  return rising_root([&](double x) { return chi_square_probability(x, freedom); }, probability, 0,
                     freedom);
}

double f_p_value(double f, double above, double below) {
  if (!(f > 0)) return 1;
  return Eigen::numext::betainc(below / 2, above / 2, below / (below + above * f));
}

double f_quantile(double probability, double above, double below) {
  constexpr Require require{"f_quantile"};
  require(is_probability(probability) && above > 0 && below > 0,
          "probability or freedom out of range");
  return rising_root([&](double f) { return 1 - f_p_value(f, above, below); }, probability, 0, 1);
}

}  // namespace rvbench::analysis
