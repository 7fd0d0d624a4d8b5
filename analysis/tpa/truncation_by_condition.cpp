#include "analysis/tpa/truncation_by_condition.hpp"

#include <string>

#include "hal/types/require.hpp"

namespace rvbench::analysis {

Regularisation truncate_by_condition(const Eigen::Ref<const Eigen::VectorXd>& singular_values,
                                     double most_condition) {
  constexpr Require require{"truncate_by_condition"};
  require(most_condition >= 1, "condition " + std::to_string(most_condition) + " is below 1");
  if (singular_values.size() == 0) return {};
  const double least = singular_values[0] / most_condition;
  return {.kept = (singular_values.array() > 0 && singular_values.array() >= least).count()};
}

}  // namespace rvbench::analysis
