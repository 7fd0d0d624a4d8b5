#pragma once

#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// Tikhonov's parameter by evidence: the ratio of noise to force under which the responses are most
/// probable, with forces and noise complex normal, each of one variance, neither of them known.
///
///     minimises  rows·log(Σ power/(s² + λ²) + outside/λ²) + Σ log(s² + λ²) + (rows - n)·log λ²
///
/// Errors  of tikhonov_by_gcv()
/// Limits  forces along the singular vectors that are not of one size spoil it: 3.4 and 22 times
///         the least error for Hansen's shaw and phillips with 0.1 % of noise
/// Source  MacKay, Neural Comput. 4(3), 415-447 (1992); for sources and transfer matrices: Pereira,
///         Antoni & Leclère, Appl. Acoust. 97, 11-29 (2015)
Regularisation tikhonov_by_evidence(const PicardPowers& line);

/// What is minimised above. Units  none. Errors, source  of tikhonov_by_evidence()
double minus_log_evidence(const PicardPowers& line, double parameter);

}  // namespace rvbench::analysis
