#pragma once

#include "analysis/tpa/matrix_inverse.hpp"

namespace rvbench::analysis {

/// Power of the indicators that no forces at the paths can cause, and what of it is to be expected.
///
///     outside of a line    Σ|(I - U·Uᴴ)·b|²,  U: left singular vectors of the FRFs
///     expected             (rows - paths)·(Σ variance·|F|² / rows + floor)
///
/// Errors of FRFs and sensors' noise leave power outside; a path that was not measured leaves more.
/// The floor of the sensors' noise, the same at all lines, is the outside power per degree of
/// freedom that one line in ten is below.
struct UnexplainedPower {
  Eigen::VectorXd outside;   ///< per line, mean over blocks, indicators' unit squared; 0: not used
  Eigen::VectorXd expected;  ///< per line, as well
  Eigen::VectorXd total;     ///< per line, of the indicators
  Eigen::Index worst_indicator = 0;  ///< the one with the largest share of its power outside

  double share() const { return outside.sum() / total.sum(); }
  double expected_share() const { return expected.sum() / total.sum(); }
};

/// @param frfs, operating, roles  as given to the analysis. @param contributions  its result
/// Shape   lines of the FRFs
/// Units   squares of the indicators'
/// Errors  throws std::invalid_argument: as many indicators as paths (nothing can be outside),
///         variances of the FRFs not known
/// Limits  what a missing path causes within the column space is not seen; one that pushes alike at
///         nine lines of ten or more is taken for noise; forces that cancel at
///         the indicators and are damped by the rule leave more outside than is expected of them
/// Source  Hansen, Discrete Inverse Problems (2010), ch. 3; the expectation: ours
UnexplainedPower unexplained_power(const FrfMatrix& frfs, const OperatingSpectra& operating,
                                   const SensorRoles& roles,
                                   const PathContributions& contributions);

}  // namespace rvbench::analysis
