#include "analysis/tpa/tikhonov_by_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/tpa/parameter_search.hpp"

namespace rvbench::analysis {

double minus_log_evidence(const PicardPowers& line, double parameter) {
  const double square = parameter * parameter;
  double scaled = line.outside / square, logs = 0;
  for (Eigen::Index k = 0; k < line.singular_values.size(); ++k) {
    const double s = line.singular_values[k];
    scaled += line.powers[k] / (s * s + square);
    logs += std::log(s * s + square);
  }
  const auto rows = double(line.rows);
  const double left_over = rows - double(line.singular_values.size());
  return rows * std::log(std::max(scaled, std::numeric_limits<double>::min())) + logs +
         left_over * std::log(square);
}

Regularisation tikhonov_by_evidence(const PicardPowers& line) {
  require_powers("tikhonov_by_evidence", line);
  return {.kept = line.singular_values.size(),
          .parameter = least_parameter(parameters_of(line.singular_values), [&](double parameter) {
            return minus_log_evidence(line, parameter);
          })};
}

}  // namespace rvbench::analysis
