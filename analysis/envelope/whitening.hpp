#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Cepstrum pre-whitening: x with every spectral line set to one amplitude, its phase kept, which
/// is its real cepstrum set to zero. A tone, however strong, is then one line among many, and what
/// is left to tell is what comes in strikes.
///
/// Shape   N → N, of variance 1 (but for what lines 0 and N/2 and lines without power leave out)
/// Limits  x is taken as periodic: a strong tone that the record cuts off rules lines for far
///         around, and shows as a strike at the ends
/// Errors  throws std::invalid_argument: N < 4, sample not finite
/// Units   none: all of x's is divided out
/// Source  Sawalhi & Randall, COMADEM (2011); Borghesani, Pennacchi, Randall, Sawalhi & Ricci,
///         Mech. Syst. Signal Process. 36(2), 370-384 (2013)
Eigen::VectorXd cepstrum_prewhitened(const Eigen::Ref<const Eigen::VectorXd>& x);

/// x with every spectral line over the noise floor around it: noise becomes white, of variance 1,
/// and tones stay as high above it as they were.
///
/// Shape, units, limits, errors  of cepstrum_prewhitened()
/// Source  ours, by line_floor(): what spectral_coherence() needs of noise
Eigen::VectorXd floor_whitened(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis
