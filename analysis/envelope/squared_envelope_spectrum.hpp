#pragma once

#include <Eigen/Core>

#include "analysis/envelope/tested_spectrum.hpp"

namespace rvbench::analysis {

/// The highest lines that a band holds are sums of fewer products of spectral lines than these, and
/// not Gaussian.
inline constexpr Eigen::Index too_few_products = 160;

/// Squared envelope spectrum of a band: how often it is struck, and how deeply its power swings.
///
/// Of Gaussian noise each line is a sum of very many products of spectral lines: complex Gaussian,
/// its power chi-square of two degrees of freedom. How its mean falls with frequency follows from
/// the noise floor of the band, how high it is is taken from the lines around: so noise that bursts
/// without a period raises the threshold, and not the alarm.
///
/// Shape   N samples → N/2 + 1 lines, of which those up to the width of the band, less
///         too_few_products, are tested
/// Units   depth: lines of the squared envelope over its mean, 0-to-peak; 1 for a power that swings
///         as a cosine down to 0, up to 2 for short strikes. Band in Hz, or in orders for samples
///         per turn
/// Limits, errors  of band_vibration(): tones that the record cuts off reach every band
/// Source  Antoni, Mech. Syst. Signal Process. 21, 597-630 (2007); Randall & Antoni, Mech. Syst.
///         Signal Process. 25(2), 485-520 (2011)
TestedSpectrum squared_envelope_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                                         double from, double to);

}  // namespace rvbench::analysis
