#pragma once

#include <Eigen/Core>
#include <vector>

namespace rvbench::analysis {

/// A peak of one singular value of a mode indicator.
struct IndicatorPeak {
  Eigen::Index line = 0;
  Eigen::Index curve = 0;  ///< 0: the largest singular value; 1: the second, of another mode there
  Eigen::Index width = 1;  ///< lines above half of its power
};

/// Peaks that fall by at least so much to both sides before the curve rises above them. Of the
/// second singular value and those after it only peaks that the largest one has as well, within two
/// lines: others are where two modes' curves cross.
///
/// Shape   lines x curves, all amplitudes; in order of curves, then of lines
/// Units   dB of amplitude squared
/// Errors  none thrown; at what is not finite a peak ends
/// Source  Shih et al., Mech. Syst. Signal Process. 2(4), 367-377 (1988); prominence as in
/// topography
std::vector<IndicatorPeak> indicator_peaks(const Eigen::MatrixXd& indicator, double least_dB);

}  // namespace rvbench::analysis
