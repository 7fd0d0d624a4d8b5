#pragma once

#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// Tikhonov's parameter at the corner of the L-curve, (log |A·x - b|, log |x|) over the parameter:
/// where it bends most.
///
/// Errors  of tikhonov_by_gcv()
/// Limits  a solution that is smooth in the singular vectors has no clear corner: 2.6 and 11 times
///         the least error for Hansen's shaw and phillips with 0.1 % of noise
/// Source  Hansen & O'Leary, SIAM J. Sci. Comput. 14(6), 1487-1503 (1993); derivatives by the
///         logarithm of the parameter are our own
Regularisation tikhonov_by_l_curve(const PicardPowers& line);

/// Curvature of the L-curve at a parameter; positive where it bends as at the corner.
/// Units   none. Errors, source  of tikhonov_by_l_curve()
double l_curve_curvature(const PicardPowers& line, double parameter);

}  // namespace rvbench::analysis
