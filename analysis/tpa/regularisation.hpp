#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// How much of each singular value of a line its inverse takes: of the first `kept` ones
/// s/(s² + parameter²) in place of 1/s, of the others nothing. Truncation has parameter 0.
struct Regularisation {
  Eigen::Index kept = 0;
  double parameter = 0;  ///< Tikhonov's, in units of the singular values

  double weight(Eigen::Index k, double singular_value) const {
    if (k >= kept || singular_value == 0) return 0;
    return singular_value / (singular_value * singular_value + parameter * parameter);
  }
};

/// What a line of responses b has along each left singular vector: what rules that ask the data go
/// by. Powers are means over as many records of b as there are.
struct PicardPowers {
  Eigen::VectorXd singular_values;  ///< n, falling, s[0] > 0
  Eigen::VectorXd powers;           ///< n: mean |uᴴ·b|²
  double outside = 0;     ///< mean |b|² that no u holds: noise, and what no path explains
  Eigen::Index rows = 0;  ///< of b, >= n
};

}  // namespace rvbench::analysis
