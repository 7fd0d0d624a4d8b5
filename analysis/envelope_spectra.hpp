#pragma once

#include <Eigen/Core>

#include "analysis/line_floor.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Envelope order spectrum of one IMF, with and without what repeats every period.
struct EnvelopeSpectra {
  double mean = 0;           ///< of the envelope: what modulation depth refers to
  double periods = 0;        ///< whole periods spanned
  double highest_order = 0;  ///< half the carrier's mean order: an envelope holds no more than that
  Spectrum whole;            ///< over orders; Hann window
  LineFloor lines;           ///< of `whole`, a little further than highest_order
  LineFloor unlocked;  ///< of the envelope minus its average over periods: what rolls or slips
};

/// Envelope of x, sampled over the shaft angle. Empty mean and spectra if no period fits.
/// Units   those of x; orders of the shaft, Hz, s
/// Limits  what swings faster than rate_Hz / 4, as two tones of one IMF beat that lie further
///         apart, is folded
/// Errors  throws std::invalid_argument of envelope(): N < 4, sample not finite
/// Source  Randall & Antoni, Mech. Syst. Signal Process. 25(2), 485-520 (2011); highest_order:
///         Bedrosian, Proc. IEEE 51(5), 868-869 (1963)
EnvelopeSpectra envelope_spectra(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                 double start_s, const ShaftAngle& angle, double period_turns);

}  // namespace rvbench::analysis
