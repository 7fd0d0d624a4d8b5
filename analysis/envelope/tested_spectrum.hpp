#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// A spectrum of an envelope, and what noise alone would show in each of its lines.
///
/// The power of a noise line, amplitude², is the mean of `averages` exponentially distributed ones:
/// a chi-square of 2·averages degrees of freedom. Its own mean is known as well as `floor_lines`
/// noise lines tell it, so power over noise has an F distribution.
///
/// Units   those of the axis and of the amplitude
/// Errors  threshold() throws std::invalid_argument: rate not in (0, 1); that a line is
///         there is up to the caller
/// Source  Percival & Walden, Spectral Analysis for Physical Applications (1993), ch. 10, for F;
///         Šidák, J. Am. Stat. Assoc. 62, 626-633 (1967), for the share
struct TestedSpectrum {
  Spectrum spectrum;      ///< over Hz; over orders if the samples are even in shaft angle
  Eigen::VectorXd noise;  ///< mean power of a noise line, in the unit of the amplitude squared
  Eigen::VectorXd floor_lines;  ///< independent noise lines that each `noise` is worth
  double averages = 1;

  /// Where its powers are not independent, what they have in common makes high lines commoner than
  /// that: of a tenth of the lines power over noise exceeds tail_from, and falls off from there on
  /// as exp(-x/tail_scale) at the slowest. What is told by tail_lines lines counts as well,
  /// whichever p-value is larger. A scale of 0: there is no such tail.
  double tail_from = 0;
  double tail_scale = 0;
  double tail_lines = 1;

  Eigen::Index first = 0;  ///< lines that say something: below are the window's own,
  Eigen::Index last = -1;  ///< above is what a band of that width does not hold

  /// Probability that noise alone raises this one line so high.
  double p_value(Eigen::Index line) const;

  /// Amplitude that noise alone exceeds in this one line so rarely, or more rarely.
  /// @param rate  in (0, 1)
  double threshold(Eigen::Index line, double rate) const;

  /// What one line may be allowed where noise may exceed any line of the spectrum at `rate`:
  /// Šidák's share of it, for lines first..last taken as independent, which errs to the safe side.
  double rate_of_one_line(double rate) const;

  /// Lines that noise alone would not show, in the whole spectrum, but at this rate.
  std::vector<Eigen::Index> significant(double rate) const;
};

/// Tested against the noise around each line: of an envelope, whose lines are exponential.
/// @param last   line beyond which the envelope holds nothing
/// @param shape  of the noise over the lines, as far as it is known, > 0; empty: it is even
/// Shape, units  those of the envelope. Errors  none thrown. Source  line_floor()
TestedSpectrum tested_against_floor(Spectrum envelope, Eigen::Index last,
                                    const Eigen::VectorXd& shape = {});

/// What a spectrum shows near a frequency.
struct LineEvidence {
  double frequency = 0;  ///< of the line that stands out most, in the unit of the axis
  double amplitude = 0;  ///< of that line
  double threshold = 0;  ///< that noise exceeds, in any line looked at, at the rate asked for
  double p_value = 1;    ///< for all lines looked at
};

/// @param within  to both sides; the nearest line at least
/// @param rate    of false alarms, in (0, 1)
/// @return p-value 1 and amplitude 0 where the spectrum does not reach
/// Units   those of the axis. Source  Šidák (1967), for all lines looked at
/// Errors  throws std::invalid_argument of threshold()
LineEvidence evidence_near(const TestedSpectrum& tested, double frequency, double within,
                           double rate);

}  // namespace rvbench::analysis
