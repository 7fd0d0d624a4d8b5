#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Lines 0..N/2 of the discrete Fourier transform of x, unscaled: X_k = Σ x_i·exp(-2πi·ik/N).
///
/// Shape    N → N/2 + 1; any N ≥ 1, primes at about five times the price
/// Threads  any number at once; the result does not depend on them, nor on where x lies in memory
/// Source   Frigo & Johnson, Proc. IEEE 93(2), 216-231 (2005)
Eigen::VectorXcd fft(const Eigen::Ref<const Eigen::VectorXd>& x);

/// The n real samples whose fft() is `lines`; inverse_fft(fft(x), x.size()) is x to rounding.
///
/// Errors  throws std::invalid_argument: lines.size() is not n/2 + 1
Eigen::VectorXd inverse_fft(Eigen::VectorXcd lines, Eigen::Index n);

}  // namespace rvbench::analysis
