#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/kinematics.hpp"
#include "analysis/line_floor.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/signature_lines.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Envelope order spectrum of one IMF, with and without what repeats every period.
struct EnvelopeSpectra {
  double mean = 0;           ///< of the envelope: what modulation depth refers to
  double periods = 0;        ///< whole periods spanned
  double highest_order = 0;  ///< half the carrier's mean order: an envelope holds no more than that
  Spectrum whole;            ///< over orders; Hann window
  LineFloor lines;           ///< of `whole`
  LineFloor unlocked;  ///< of the envelope minus its average over periods: what rolls or slips
};

/// Envelope of x, sampled over the shaft angle. Empty mean and spectra if no period fits.
/// Units   those of x; orders of the shaft, Hz, s
/// Errors  throws std::invalid_argument of envelope(): N < 4, sample not finite
/// Source  Randall & Antoni, Mech. Syst. Signal Process. 25(2), 485-520 (2011); highest_order:
///         Bedrosian, Proc. IEEE 51(5), 868-869 (1963)
EnvelopeSpectra envelope_spectra(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                 double start_s, const ShaftAngle& angle, double period_turns);

/// What one signature shows in one IMF.
struct FamilyScore {
  double order = 0;                 ///< fundamental as found
  double statistic = 0;             ///< Σ power/floor over the family's lines
  double p_value = 1;               ///< for all orders tried within slip or tolerance
  double depth = 0;                 ///< modulation depth of the family, noise taken out
  std::vector<double> line_depths;  ///< of each line, same order as `lines` given
};

/// Scores all signatures on one envelope.
///
/// Of the parts that roll, the deepest family explains its lines first, and the others count what
/// is left: within the slip allowed, 3·BPFO of one race falls on 2·BPFI of the other. A sideband of
/// theirs counts up to its harmonic: blows that a load modulates, which is never negative, have no
/// sideband above it.
///
/// @param lines  from signature_lines(); those of a family are scaled together within its slip
///               or tolerance
/// Shape   one score per signature, in their order; `lines` has a list for each
/// Units   orders; depths over the mean envelope
/// Errors  none thrown; a family of which no line is held has p-value 1
/// Source  line_p_value() for a family's sum; who explains what first is ours
std::vector<FamilyScore> score_families(const EnvelopeSpectra& envelope,
                                        const std::vector<Signature>& signatures,
                                        const std::vector<std::vector<SignatureLine>>& lines);

}  // namespace rvbench::analysis
