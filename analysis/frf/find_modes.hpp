#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "hal/types/frequency_response.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// A natural frequency and its damping, as all responses tell it together.
struct FoundMode {
  double frequency_Hz = 0;          ///< undamped natural frequency
  double damping_ratio = 0;         ///< of critical; an exponential window's share is taken out
  double frequency_error_Hz = 0;    ///< standard error, by what the fit leaves over
  double damping_error = 0;         ///< standard error of damping_ratio
  double p_value = 1;               ///< that noise alone improves a fit that much, of all tried
  double stands_out_dB = 0;         ///< its own part at its peak, over everything else there
  std::vector<std::string> doubts;  ///< why it is uncertain; empty: sure
  Eigen::VectorXcd residues;        ///< per response, rad/s times unit of the fitted responses

  bool sure() const { return doubts.empty(); }
};

/// Where and how modes are looked for.
struct ModeSearch {
  double from_Hz = 0;
  double to_Hz = std::numeric_limits<double>::infinity();
  double span_Hz = not_known;  ///< the test claims no more; modes above are found, and doubted
  double decay_s = std::numeric_limits<double>::infinity();  ///< exponential window in the data
  double least_prominence_dB = 1;  ///< of a peak of the indicator above the valleys beside it
  double false_alarms = 1e-3;      ///< of noise alone, in the whole search
};

/// Modes of a set of frequency responses of one structure: peaks of the mode indicator, each fitted
/// by a common pole in the band around it, with as many poles as the indicator has peaks there.
///
/// A peak is a mode if its pole, whose residues are new numbers for every response, improves the
/// fit as noise would not (F test), lies at the peak and is damped. It is doubted if fits of a
/// narrower and a wider band differ by more than half of its half-power bandwidth, if all else is
/// stronger at its peak, if its damping is not known to a third, is all of the window's or above a
/// fifth, if the fit explains less than half, or if it lies above the span.
///
/// Shape   K responses of the same lines; in order of frequency; fitted as mobilities where their
///         units tell what they are
/// Units   Hz, as they are stated
/// Errors  throws std::invalid_argument of mode_indicator(), or where the search makes no sense
/// Limits  of two modes within a line or a half-power bandwidth both are found only where several
///         excitations were measured. Lines that are correlated (zero padding, a short exponential
///         window, a Hann window) make the test too sure. A mode at a node of all places is not
///         seen
/// Source  Shih et al., Mech. Syst. Signal Process. 2(4), 367-377 (1988); fit_poles()
std::vector<FoundMode> find_modes(const std::vector<FrequencyResponse>& responses,
                                  const ModeSearch& search);

}  // namespace rvbench::analysis
