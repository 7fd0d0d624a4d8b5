#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// The smallest step from one sample to the next, if they differ: what a converter or an encoder
/// parts.
///
/// Shape   N samples; those that are not finite have no step
/// Units   of x
/// @return infinite where no two neighbours differ
/// Errors  none thrown. Source  ours
double smallest_step(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis
