#pragma once

#include <vector>

#include "analysis/tpa/line_svd.hpp"
#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// Forces per response, line by line, and how each line was regularised.
struct RegularisedInverse {
  LineMatrices values;                ///< columns x rows of the matrix, in 1/(its units)
  std::vector<Regularisation> lines;  ///< as asked for
  Eigen::VectorXd conditions;         ///< largest over least singular value; infinite if that is 0
};

/// V·diag(weights)·Uᴴ of each line.
///
/// @param rules  one per line
/// Errors  throws std::invalid_argument: as many rules as lines are not given, a rule keeps more
///         singular values than there are or less than none, a parameter negative or not finite
/// Threads up to `threads` (0: the free cores); the result does not depend on them
/// Source  Hansen, Rank-Deficient and Discrete Ill-Posed Problems (1998), ch. 4 and 5
RegularisedInverse regularised_inverse(const LineSvd& svd, std::vector<Regularisation> rules,
                                       unsigned threads = 0,
                                       const SvdKernels& kernels = svd_kernels());

}  // namespace rvbench::analysis
