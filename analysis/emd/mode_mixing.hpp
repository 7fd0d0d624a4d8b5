#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// How far IMFs are from standing at right angles: all their products with each other over the
/// power of their sum. 0 if every two are orthogonal; a few hundredths are usual, and tenths a sign
/// that an oscillation is in two IMFs.
///
/// Shape   N x K, samples by IMFs → one, dimensionless; 0 for K < 2, and where nothing swings
/// Errors  none thrown
/// Source  Huang et al., Proc. R. Soc. A 454, 903-995 (1998), sec. 6
double orthogonality_index(const Eigen::Ref<const Eigen::MatrixXd>& imfs);

/// How much of the same frequencies each IMF and the next one have: the power that their spectra
/// share, line by line, over that of the weaker one. 0 if they part all frequencies, 1 if the
/// weaker one is at none of its own. IMFs of noise overlap by about a third: a filter bank an
/// octave wide.
///
/// Shape   N x K, samples by IMFs → K - 1; NaN beside an IMF of no power
/// Errors  throws std::invalid_argument: N < 2, sample not finite
/// Source  ours; the filter bank: Flandrin, Rilling & Gonçalvès, IEEE Signal Process. Lett. 11(2),
///         112-114 (2004)
Eigen::VectorXd spectral_overlap(const Eigen::Ref<const Eigen::MatrixXd>& imfs);

}  // namespace rvbench::analysis
