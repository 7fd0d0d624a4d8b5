#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Magnitude of the analytic signal of x: its envelope.
///
/// Shape   N → N; any N, even primes
/// Limits  x is taken as periodic: the first and last cycles see each other
/// Errors  throws std::invalid_argument: N < 4, sample not finite
/// Source  Marple, IEEE Trans. Signal Process. 47(9), 2600-2603 (1999)
Eigen::VectorXd envelope(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis
