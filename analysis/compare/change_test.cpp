#include "analysis/compare/change_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_p = 1e-300;

// P(T > t)
double upper_tail(double t, double freedom) {
  const double beyond = 0.5 * (std::isinf(t) ? 0.0 : t_p_value(t, freedom));
  return t >= 0 ? beyond : 1 - beyond;
}

// The t that T exceeds with probability p.
double upper_t(double p, double freedom) {
  if (p >= 0.5) return 0;
  return t_of_p_value(2 * std::max(p, least_p), std::max(freedom, 1.0));
}

}  // namespace

ChangeTest test_change(double change_dB, double values_a, double values_b, const Scatter& scatter,
                       double least_dB) {
  ChangeTest test{change_dB, scatter, 0, 1};
  test.error_dB = std::sqrt(scatter.variance * (1 / values_a + 1 / values_b));
  const double beyond = std::abs(change_dB) - least_dB;
  if (test.error_dB == 0) {
    test.p_value = beyond > 0 ? 0 : 1;
    return test;
  }
  const double tails =
      upper_tail(beyond / test.error_dB, scatter.freedom) +
      upper_tail((std::abs(change_dB) + least_dB) / test.error_dB, scatter.freedom);
  test.p_value = std::min(1.0, tails);
  return test;
}

double half_width(const ChangeTest& test) {
  return upper_t(0.025, test.scatter.freedom) * test.error_dB;
}

double detectable_change(const ChangeTest& test, double least_dB, double p) {
  if (!(test.scatter.freedom > 0)) return infinity;
  const double t = upper_t(p, test.scatter.freedom) + upper_t(0.1, test.scatter.freedom);
  return least_dB + t * test.error_dB;
}

}  // namespace rvbench::analysis
