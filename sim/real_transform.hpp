#pragma once

#include <complex>

namespace rvbench::sim {

/// Lines 0..N/2 of the N samples' discrete Fourier transform, unscaled; and the samples from such
/// lines, scaled by 1/N. Any number of threads at once: each keeps plans of its own.
///
/// Source  Frigo & Johnson, Proc. IEEE 93(2), 216-231 (2005)
void lines_from_samples(std::complex<double>* lines, const double* samples, long count);
void samples_from_lines(double* samples, const std::complex<double>* lines, long count);

}  // namespace rvbench::sim
