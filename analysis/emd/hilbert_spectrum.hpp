#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// The power of IMFs over their instantaneous frequency, all of the record together.
struct MarginalSpectrum {
  double resolution_Hz = 0;  ///< bin k holds frequencies from k to k + 1 of it
  Eigen::VectorXd power;     ///< mean square of a swing of that frequency, unit² of the signal
  double unplaced = 0;       ///< power at instants whose frequency is negative or none at all
};

/// Marginal Hilbert spectrum: at each sample half the squared envelope of each IMF goes into the
/// bin of its instantaneous frequency; the mean of all samples is taken. What a line of a Fourier
/// spectrum has to be steady for stays in its bin here though it comes and goes; what swings about
/// is spread over the bins that it passes.
///
/// Shape    N x K IMFs, as emd() has them → `bins` bins from 0 to rate_Hz / 2
/// Units    Hz; that of the signal, squared
/// Errors   throws std::invalid_argument: N < 4, sample not finite, rate_Hz or bins not positive
/// Source   Huang et al., Proc. R. Soc. A 454, 903-995 (1998), sec. 7
MarginalSpectrum marginal_spectrum(const Eigen::Ref<const Eigen::MatrixXd>& imfs, double rate_Hz,
                                   Eigen::Index bins);

}  // namespace rvbench::analysis
