#pragma once

#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// Tikhonov's parameter by generalised cross-validation: the one whose fit best predicts each
/// response from the others.
///
///     G(λ) = (Σ (1 - φ)²·power + outside) / (rows - Σ φ)²,   φ = s²/(s² + λ²)
///
/// Errors  throws std::invalid_argument: other powers than singular values, s[0] not above 0
/// Limits  with as few rows as columns or little noise its minimum is flat, and may lie too low
/// Source  Golub, Heath & Wahba, Technometrics 21(2), 215-223 (1979)
Regularisation tikhonov_by_gcv(const PicardPowers& line);

/// G(λ) above. Units  of |b|². Errors, source  of tikhonov_by_gcv()
double gcv(const PicardPowers& line, double parameter);

}  // namespace rvbench::analysis
