#include "analysis/tpa/tikhonov_by_gcv.hpp"

#include <limits>

#include "analysis/tpa/parameter_search.hpp"

namespace rvbench::analysis {

double gcv(const PicardPowers& line, double parameter) {
  const double square = parameter * parameter;
  double rest = line.outside, freedom = double(line.rows);
  for (Eigen::Index k = 0; k < line.singular_values.size(); ++k) {
    const double s = line.singular_values[k];
    const double damped = square / (s * s + square);
    rest += damped * damped * line.powers[k];
    freedom -= 1 - damped;
  }
  // As many rows as columns and no damping leave nothing to validate with.
  return freedom > 0 ? rest / (freedom * freedom) : std::numeric_limits<double>::infinity();
}

Regularisation tikhonov_by_gcv(const PicardPowers& line) {
  require_powers("tikhonov_by_gcv", line);
  return {.kept = line.singular_values.size(),
          .parameter = least_parameter(parameters_of(line.singular_values),
                                       [&](double parameter) { return gcv(line, parameter); })};
}

}  // namespace rvbench::analysis
