#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// A band of frequencies, both ends included.
struct FrfBand {
  double from_Hz = 0, to_Hz = 0;
};

/// Lines of a band, of those at first_Hz, first_Hz + step_Hz, ...
struct BandLines {
  Eigen::Index first = 0, count = 0;  ///< first of those there are, however many they are
};

/// Lines within the band, to a thousandth of a step; none: count is 0 or less.
/// Units  Hz. Errors  none thrown. Source  definition
BandLines lines_of(const FrfBand& band, double first_Hz, double step_Hz);

}  // namespace rvbench::analysis
