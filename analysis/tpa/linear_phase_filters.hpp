#pragma once

#include "analysis/tpa/fir_matrix.hpp"

namespace rvbench::analysis {

/// The article's design of a deconvolution network: frequency sampling with linear phase,
///
///     S(k) = |S(ω_k)|·exp(-j·τ·ω_k),   τ = (N - 1)/2,   N = rate/step taps,
///
/// and s(n) its inverse discrete Fourier transform. It keeps of S the magnitude alone: the phase
/// between a response and a force, and between the responses that a force is summed from, is lost.
/// A force through one path comes with the right amplitude at each line, at the wrong time; one
/// that several responses make up is wrong altogether. deconvolution_filters() keeps the phase.
///
/// Shape   s: forces x responses per line → as many filters; lines that are not there count as 0,
///         as does that at half the rate, which no linear phase of an even number of taps can have
/// Units   those of s
/// Errors  throws std::invalid_argument: of filter_grid()
/// Source  Xie, Cheng & Li, "Vibration Diagnosis and Optimization of Industrial Robot Based on TPA
///         and EMD Methods", eqs. 5-9
FirMatrix linear_phase_filters(const LineMatrices& s, double first_Hz, double step_Hz,
                               double rate_Hz);

}  // namespace rvbench::analysis
