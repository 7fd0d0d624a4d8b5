#pragma once

#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// Keeps as many singular values as the corner of the L-curve has: points (log |A·x - b|, log |x|)
/// for 1 ... n of them, which fall while x explains b and rise once it only follows noise.
///
/// The corner is the point with the sharpest angle to an earlier point and the last one, of those
/// below 7π/8 that turn as an L does; without any, all n are kept.
///
/// Errors  throws std::invalid_argument: powers of another number than the singular values
/// Limits  of tikhonov_by_l_curve(), and worse: 79 times the least error for phillips
/// Source  Castellanos, Gómez & Guerra, Appl. Numer. Math. 43(4), 359-373 (2002): the triangle
///         method; Hansen, SIAM Rev. 34(4), 561-580 (1992)
Regularisation truncate_by_l_curve(const PicardPowers& line);

}  // namespace rvbench::analysis
