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
/// Errors  none thrown. Source  Student's t with the degrees of freedom of the fit
double p_value_of_growth(const Growth& growth, const GrowthRange& range);

/// What a p-value leaves of the odds of a hypothesis, at most: -e·p·ln p below p = 1/e, else 1.
/// Errors  none thrown
/// Source  Sellke, Bayarri & Berger, The American Statistician 55(1), 62-71 (2001), eq. 3
double odds_at_most(double p_value);

}  // namespace rvbench::analysis
