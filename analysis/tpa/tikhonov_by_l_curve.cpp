#include "analysis/tpa/tikhonov_by_l_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/tpa/parameter_search.hpp"

namespace rvbench::analysis {

// With t = log λ and φ = s²/(s² + λ²): dφ/dt = -2φ(1 - φ), and for the squared norms η of x and ρ
// of the rest dρ/dt = -λ²·dη/dt.
double l_curve_curvature(const PicardPowers& line, double parameter) {
  const double square = parameter * parameter;
  double norm = 0, norm_t = 0, norm_tt = 0, rest = line.outside;
  for (Eigen::Index k = 0; k < line.singular_values.size(); ++k) {
    const double s = line.singular_values[k];
    if (s == 0) {
      rest += line.powers[k];
      continue;
    }
    const double kept = s * s / (s * s + square), damped = square / (s * s + square);
    const double share = kept * kept * line.powers[k] / (s * s);
    norm += share;
    norm_t -= 4 * damped * share;
    norm_tt += 8 * damped * (2 - 3 * kept) * share;
    rest += damped * damped * line.powers[k];
  }
  constexpr double nothing = std::numeric_limits<double>::min();
  if (norm <= nothing || rest <= nothing) return 0;
  const double rest_t = -square * norm_t, rest_tt = -square * (2 * norm_t + norm_tt);
  const double x = rest_t / rest / 2, y = norm_t / norm / 2;
  const double x_t = rest_tt / rest / 2 - 2 * x * x, y_t = norm_tt / norm / 2 - 2 * y * y;
  const double speed = std::hypot(x, y);
  return speed > 0 ? (x * y_t - x_t * y) / (speed * speed * speed) : 0;
}

Regularisation tikhonov_by_l_curve(const PicardPowers& line) {
  require_powers("tikhonov_by_l_curve", line);
  // Below the least singular value the curve ends: it bends there for no reason of the data's.
  const Eigen::Index n = line.singular_values.size();
  const double largest = line.singular_values[0];
  const ParameterRange range{std::max(line.singular_values[n - 1], 1e-14 * largest), largest};
  return {.kept = n, .parameter = least_parameter(range, [&](double parameter) {
                       return -l_curve_curvature(line, parameter);
                     })};
}

}  // namespace rvbench::analysis
