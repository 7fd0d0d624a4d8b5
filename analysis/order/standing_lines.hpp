#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// A peak of a spectrum that its floor does not explain.
struct StandingLine {
  double place = 0;      ///< of the tone, in lines
  double amplitude = 0;  ///< of the highest line, 0-to-peak, in the unit of the signal
  double p_value = 1;    ///< of noise alone reaching it in this one line
};

/// What a tone under a Hann window leaves, at the most, so many lines away from it: a share of its
/// amplitude. 1 within its own peak, two lines to each side.
/// Units   lines, of either sign → none, 0 to 1. Errors  none thrown
/// Source  Harris, Proc. IEEE 66(1), 51-83 (1978): 18 dB per octave
double hann_leakage(double lines_away);

/// The peaks of a Hann spectrum between lines 2 and `last` that noise would raise with a
/// probability of at most alpha each, strongest first. What a stronger one leaks is no line: a peak
/// must be twice what all that are stronger leave there.
///
/// Shape    as many as there are; a peak's neighbours within 2 lines are its own
/// Units    lines; those of the spectrum
/// Errors   throws std::invalid_argument: floor and spectrum of different length
/// Source   floor and p-value: line_floor(), line_p_value(); place: place_of_tone()
std::vector<StandingLine> standing_lines(const Spectrum& spectrum, const LineFloor& floor,
                                         Eigen::Index last, double alpha);

}  // namespace rvbench::analysis
