#pragma once

#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// Keeps the singular values that are above the largest divided by `most_condition`.
///
/// @param singular_values  falling. @param most_condition  >= 1
/// Errors  throws std::invalid_argument: most_condition < 1. All 0: keeps none
/// Source  Hansen, SIAM J. Sci. Stat. Comput. 11(3), 503-518 (1990)
Regularisation truncate_by_condition(const Eigen::Ref<const Eigen::VectorXd>& singular_values,
                                     double most_condition);

}  // namespace rvbench::analysis
