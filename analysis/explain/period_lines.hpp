#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/shaft_angle.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// What a signal of a steadily turning machine shows: its mean, and the lines that repeat with the
/// machine's period.
struct PeriodLines {
  double mean = 0;            ///< in the signal's unit
  double periods = 0;         ///< whole ones that it was taken over
  Eigen::VectorXd amplitude;  ///< 0-to-peak; element k: k times per period; element 0 is unused
  Eigen::VectorXd noise;      ///< rms amplitude that noise alone shows there
  /// The same of the strongest line between orders k and k + 1, where nothing that repeats shows.
  Eigen::VectorXd between, between_noise;
};

/// Amplitudes at every whole order of the period, by averaging over whole periods of the shaft
/// angle; the noise beside each comes from the lines between the orders, which nothing that repeats
/// can fill. Orders above 0.4 of the sample rate are left out.
///
/// @param period_turns  input turns per period
/// @return empty if the signal is shorter than four periods: then a line cannot be told from its
///         neighbour
/// Shape   one amplitude per order of the period, from 0 up to 0.4 of the sample rate
/// Units   that of the signal; per period
/// Errors  throws std::invalid_argument of amplitude_spectrum(): sample not finite
/// Source  McFadden, Mech. Syst. Signal Process. 1(1), 83-95 (1987); noise: line_floor()
std::optional<PeriodLines> period_lines(const Channel& signal, const ShaftAngle& angle,
                                        double period_turns);

/// One line that follows time.
struct TimedLine {
  double amplitude = 0;  ///< 0-to-peak
  double noise = 0;      ///< rms amplitude that noise alone shows there
};

/// The line at a frequency, on a line of the spectrum or not.
/// @param frequency_Hz  in (0, half the sample rate)
/// Units   that of the signal. Errors  of amplitude_spectrum()
/// Source  Heinzel, Rüdiger & Schilling (2002): a Hann window, read at the frequency itself
TimedLine line_at(const Channel& signal, double frequency_Hz);

/// Subtracts the line at this frequency, so that none of it leaks into others. A line that lies
/// four or more of 1/duration away is left as it is to a part in 10,000.
/// @param frequency_Hz  in (0, half the sample rate)
/// Units   that of the signal. Errors  none thrown. Source  of line_at()
void take_out_line(Channel& signal, double frequency_Hz);

}  // namespace rvbench::analysis
