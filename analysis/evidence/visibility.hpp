#pragma once

#include <Eigen/Core>
#include <functional>

namespace rvbench::analysis {

/// The sum of log ratios that a comb must be expected to reach so that noise lets nine of ten
/// records show it at `significant_p`.
/// Source  decoy_p_value(), inverted, and 1.28 deviations of the sum for the nine of ten
double visible_sum(const Eigen::Ref<const Eigen::VectorXd>& decoys);

/// The least severity at which a rising sum reaches what is asked; infinite where it never does.
/// Limits  to 1 %, between 1e-4 and 1e4
double severity_reaching(double asked, const std::function<double(double severity)>& sum);

}  // namespace rvbench::analysis
