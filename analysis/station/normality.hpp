#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Probability that normal values of unknown mean and variance look as little normal as these, by
/// the Anderson-Darling statistic, which looks at the tails above all.
///
/// Shape   8 values or more, in any order. Units  none
/// Errors  throws std::invalid_argument: fewer, or one not finite. Values all alike: 0
/// Limits  a fit of the tables, to a few per cent from 0.01 up; below 1e-6 it is told as that
/// Source  D'Agostino & Stephens, Goodness-of-Fit Techniques (1986), table 4.9 (case 3)
double normality_p_value(const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace rvbench::analysis
