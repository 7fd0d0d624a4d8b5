#include "analysis/smallest_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rvbench::analysis {

double smallest_step(const Eigen::Ref<const Eigen::VectorXd>& x) {
  double step = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    const double change = std::abs(x[i] - x[i - 1]);
    if (change > 0) step = std::min(step, change);
  }
  return step;
}

}  // namespace rvbench::analysis
