#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "analysis/compare/slipping_comb.hpp"
#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Where a line of a part that slips stands in a spectrum.
struct SlippingLine {
  double order = not_known;  ///< NaN: the line is of no such part
  double p_value = 1;        ///< of all lines of the part together
  bool taken = false;        ///< what stands there is the line of another part, or may be
};

/// Two signatures, by their indices in the kinematics; the lower one first.
using SignaturePair = std::pair<std::size_t, std::size_t>;

struct SlippingLines {
  std::vector<SlippingLine> lines;      ///< one per quantity
  std::vector<SignaturePair> unparted;  ///< peaks of the one may as well be those of the other
};

/// Finds the lines of all signatures that may stray, and gives each peak to one of them.
///
/// All lines of a signature are stretched together, to where they stand out most: a part has one
/// slip. They are believed as far as the same search finds no as strong a sum where no such part
/// has lines: the spectrum may be full of peaks. The part that is surest takes its peaks first, the
/// others are looked for in what is left; a peak at which lines of two stand that are both found is
/// neither's, and whole orders are the input shaft's. All are looked for up
/// to one order, the highest line that is compared, those of few harmonics in the further ones: the
/// sixth of an outer race lies next to the fourth of the inner one.
///
/// A part whose lines, looked for alone, lie on more than half of the peaks of the first cannot be
/// parted from it, and keeps them, too. Nor can two that are both found, of which one repeats a
/// whole number of times while the other does once: rolling elements that are unequal mark the
/// outer race once per turn of the cage.
///
/// Shape   one line per quantity, in their order
/// Units   orders of the input shaft; relative
/// @param floor        line_floor() of the spectrum: decoys are compared over the same
/// @param blocks       independent ones that the spectrum is the mean of, in power; >= 1
/// @param speed_error  how far orders may be off besides
/// Limits  two bearings of which one's lines fall on more than half of the other's cannot be told
///         apart, whatever else they show
/// Errors  none thrown
/// Source  ours; who explains first: as score_rolling() has it; where each stands: SlippingComb
SlippingLines find_slipping_lines(const Kinematics& kinematics,
                                  const std::vector<Quantity>& quantities, const Spectrum& spectrum,
                                  const LineFloor& floor, double blocks, double speed_error);

}  // namespace rvbench::analysis
