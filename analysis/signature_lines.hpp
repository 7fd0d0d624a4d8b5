#pragma once

#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// One envelope line that a signature looks at.
struct SignatureLine {
  double order = 0;
  int sideband_of = -1;  ///< index of its harmonic in the same list; −1: a harmonic itself

  /// Lines of other parts' combs to either side, where such a comb also falls on `order`: what
  /// the line holds beyond the strongest of them is this signature's own.
  std::vector<double> rivals;
};

/// A harmonic of a signature's order, and behind it its sidebands, lower before upper.
///
/// @param stretch  of the harmonic, by slip; not of the spacings: a shaft does not slip, and a
///                 cage, less than half a turn per turn of its race, by half a percent of that
/// Units   orders of the input shaft, as searched or below 0; h = 0 gives the sidebands' spacings
/// Errors  none thrown
/// Source  amplitude modulation; Randall, Vibration-based Condition Monitoring (2011), sec. 2.2
std::vector<double> harmonic_lines(const Signature& signature, int harmonic, double stretch = 1);

/// The envelope lines that speak for each signature.
///
/// A line that is a lower harmonic of another part belongs to that part: the planet's third
/// harmonic is the sun's first, and says nothing about the planet. Of two equal claims the first
/// listed wins. Sidebands that fall on another part's harmonics are dropped.
///
/// @param resolution  orders per line: what lies closer than 0.75 of it is the same line
/// @return one list per signature, ascending harmonics, sidebands behind their harmonic
/// Units   orders of the input shaft
/// Errors  none thrown
/// Source  ours: what an order is worth to one part where several share it
std::vector<std::vector<SignatureLine>> signature_lines(const Kinematics& kinematics,
                                                        double resolution);

}  // namespace rvbench::analysis
