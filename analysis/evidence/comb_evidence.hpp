#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/envelope_spectra.hpp"
#include "analysis/evidence/signature_comb.hpp"

namespace rvbench::analysis {

/// What the lines of one comb hold in one envelope spectrum, or in several together.
struct CombEvidence {
  /// Lines × stretches: logarithm of the likelihood ratio, line of free amplitude and phase against
  /// noise alone. Of noise exponentially distributed with mean 1, however few lines gave the floor;
  /// where a rival counts as well, at most so.
  Eigen::MatrixXd log_ratio;
  Eigen::MatrixXd depth2;    ///< lines × stretches: squared modulation depth, noise taken out
  Eigen::MatrixXd variance;  ///< lines × stretches: of depth2, by noise
  Eigen::MatrixXd decoys;    ///< lines × shifts: log_ratio
  std::vector<Eigen::Index> shifts;  ///< decoy_shifts()
};

/// Reads the lines of a comb off one envelope.
///
/// With X the power of a line and F its floor, worth m independent noise lines, the likelihood of a
/// line with free amplitude over that of noise alone is ln Λ = (m + 1)·ln(1 + X/(m·F)). Of it
/// stands here the share
///
///     m·ln(1 + X/(m·F))  →  X/F   for a floor that is known well,
///
/// which is also -ln p of the line: X/F of noise is F-distributed with 2 and 2m degrees of freedom.
///
/// A line that lies on the gear train's counts nothing for what rolls. A sideband of a part that
/// rolls counts up to its harmonic: blows that a load modulates, which is never negative, have no
/// sideband above it. Of two combs that meet at a harmonic, a line counts by what it has over the
/// other's at the same place.
///
/// Shape   all of CombEvidence; zeros where the envelope does not reach
/// Units   dimensionless
/// Errors  none thrown
/// Source  Kay, Fundamentals of Statistical Signal Processing, vol. 2 (1998), ch. 6 and 9: GLRT of
///         a sinusoid in noise of unknown level
CombEvidence comb_evidence(const EnvelopeSpectra& envelope, const SignatureComb& comb);

}  // namespace rvbench::analysis
