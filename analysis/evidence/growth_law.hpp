#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Fits how what a signature modulates grows over the points of a matrix:
///
///     ln(depth·rms) = a + p·ln(load) + q·ln(speed),   averaged over the channels
///
/// Load or speed is left out where it does not vary by a factor of 1.5; points without load are, as
/// they have no logarithm. The speed's exponent holds the path from the part to the sensors as
/// well, which no one knows: it tells less than the load's, for which the path stays the same.
///
/// Limits  points too weak to show it are not among them, which pulls exponents to 0; the rms is
///         that of the whole channel, so what else grows in it counts; channels that miss it at one
///         point are left out at all
/// @param points     that show the signature, same channels in each
/// @param signature  index into their scores
/// @return exponents that are not known are NaN: fewer than 2 points more than unknowns, or speed
///         and load that went together
/// Units   exponents; their errors are half of 95 % intervals
/// Errors  none thrown
/// Source  Draper & Smith, Applied Regression Analysis (3rd ed., 1998), ch. 5
GrowthLaw growth_law(const std::vector<const Examination*>& points, std::size_t signature);

/// How likely an exponent within the range would have been measured as far outside as it was, or
/// farther: 1 inside it, and where the exponent is not known; 0.05 where its interval touches it.
///
/// Source  normal errors
double p_value_of_growth(const Growth& growth, const GrowthRange& range);

}  // namespace rvbench::analysis
