#pragma once

#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Median over mean of a noise line's power in the mean of so many blocks: ln 2 of one block.
/// @param blocks  independent ones; >= 1
/// Units  none. Errors  none thrown
/// Source  the mean of exponential distributions is a gamma distribution of shape `blocks`; its
///         median by bisection
double noise_median(double blocks);

/// The floor of a spectrum that is the mean of blocks: that of line_floor(), which is of one block,
/// with the median that the mean has.
///
/// @param locked_every  of line_floor()
/// @param blocks        independent ones that the spectrum is the mean of, in power; >= 1
/// Shape, units, errors  of line_floor(), which it is for one block
/// Limits  of blocks that overlap the floor is up to 6 % too high, of one and a half up to 20 %:
///         p-values err to the safe side
/// Source  noise_median()
LineFloor block_floor(const Spectrum& spectrum, Eigen::Index locked_every, double blocks);

}  // namespace rvbench::analysis
