#pragma once

#include <vector>

#include "analysis/spectrum.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// One channel's spectrum, and its noise: what it is compared with its neighbours by.
struct Heard {
  std::string unit;
  Spectrum spectrum;    ///< Hann
  double rms = 0;       ///< of all from 20 Hz to 0.4 of the sample rate
  double noise = 0;     ///< rms there if every line were as its octave's middle one
  double evenness = 0;  ///< of that noise: lowest over highest octave's power density; white: 1
};

/// A channel as it is compared with others.
/// @throws std::invalid_argument as amplitude_spectrum() does
/// Shape, units  N → N/2 + 1 lines, in the channel's unit; Hz
/// Source  ours: each octave's noise by its median, which lines do not move
Heard heard(const Channel& channel);

/// rms of all that lies within two lines of a frequency: a tone under the Hann window, and the
/// noise there. 0 beyond half the sample rate.
/// Units   that of the spectrum; Hz. Errors  none thrown
/// Source  Heinzel, Rüdiger & Schilling (2002), for the window's noise bandwidth
double rms_at(const Spectrum& spectrum, double frequency_Hz);

}  // namespace rvbench::analysis
