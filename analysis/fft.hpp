#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Lines 0..N/2 of the discrete Fourier transform of x, unscaled: X_k = Σ x_i·exp(-2πi·ik/N).
///
/// Shape    N → N/2 + 1; any N ≥ 1, primes at about five times the price
/// Threads  any number at once; the result does not depend on them, nor on where x lies in memory
/// Units    those of x times samples
/// Errors   throws std::invalid_argument: N = 0 or above 2³¹ - 1; not finite in, not finite out
/// Source   Frigo & Johnson, Proc. IEEE 93(2), 216-231 (2005)
Eigen::VectorXcd fft(const Eigen::Ref<const Eigen::VectorXd>& x);

/// The n real samples whose fft() is `lines`; inverse_fft(fft(x), x.size()) is x to rounding.
///
/// Errors  throws std::invalid_argument: lines.size() is not n/2 + 1
/// Units, source  of fft()
Eigen::VectorXd inverse_fft(Eigen::VectorXcd lines, Eigen::Index n);

/// The same of complex samples: N → N lines, those from N/2 on of negative frequency.
/// Units, threads, errors, source  of fft()
Eigen::VectorXcd complex_fft(Eigen::VectorXcd x);

/// The complex samples whose complex_fft() is `lines`, to rounding: N → N.
/// Units, errors, source  of fft()
Eigen::VectorXcd inverse_complex_fft(Eigen::VectorXcd lines);

/// The least number from n on that has no factor but 2, 3 and 5: transforms of it are fast.
/// @param n  >= 1
/// Errors  throws std::invalid_argument: n < 1
/// Source  FFTW manual, "Complex DFTs": sizes of small factors are the fast ones
Eigen::Index next_fast_length(Eigen::Index n);

/// The largest such length that is no more than n.
Eigen::Index fast_length_within(Eigen::Index n);

}  // namespace rvbench::analysis
