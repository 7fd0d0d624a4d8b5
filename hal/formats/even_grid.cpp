#include "hal/formats/even_grid.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::hal::formats {

std::optional<double> even_step(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  if (n < 2 || !x.allFinite()) return std::nullopt;
  const double step = (x[n - 1] - x[0]) / static_cast<double>(n - 1);
  if (!(step > least_step) || !std::isfinite(step)) return std::nullopt;
  const double rounding = 6e-6 * x.cwiseAbs().maxCoeff();
  const double most_off = std::min(0.01 * step + rounding, 0.3 * step);
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(n, x[0], x[n - 1]);
  if ((x - line).cwiseAbs().maxCoeff() > most_off) return std::nullopt;
  return step;
}

}  // namespace rvbench::hal::formats
