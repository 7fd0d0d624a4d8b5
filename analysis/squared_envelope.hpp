#pragma once

#include <Eigen/Core>

#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// What a random vibration shows between two frequencies.
struct BandVibration {
  Eigen::VectorXd mean_square;  ///< of equal parts of the band, unit²
  Spectrum depth;               ///< lines of the squared envelope over its mean, 0-to-peak, over Hz
};

/// Levels of a band, and how its power comes and goes.
///
/// Shape   N → `parts` levels and N/2 + 1 lines of depth
/// Units   that of x squared; depth without; Hz
/// @param parts  that the band is cut into, >= 1
/// Limits  the mean is left out; a line between two lines of `depth` reads up to 1.42 dB low; the
///         closer a line of `depth` is to the width of the band, the less of it is held
/// Errors  throws std::invalid_argument: band not within half the rate, fewer than 4 samples, a
///         sample not finite
/// Source  Antoni, Mech. Syst. Signal Process. 21, 597-630 (2007): squared envelope spectrum
BandVibration band_vibration(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                             double from_Hz, double to_Hz, Eigen::Index parts);

/// The largest depth near a frequency, and what noise alone shows there.
struct DepthNear {
  double depth = 0;
  double noise = 0;        ///< the largest that noise would show, as a root mean square
  double noise_sigma = 0;  ///< of one line's real and imaginary parts
};

/// @param frequency_Hz  in (0, the highest of `depth`)
/// @param within_Hz     to both sides, one line at least
/// @return no noise if there is no line beside to tell it
/// Units   Hz; those of `depth`
/// Errors  none thrown
/// Source  ours: the median of 20 lines to each side, which are Rayleigh distributed in noise
DepthNear depth_near(const Spectrum& depth, double frequency_Hz, double within_Hz);

}  // namespace rvbench::analysis
