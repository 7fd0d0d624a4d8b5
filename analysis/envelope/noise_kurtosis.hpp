#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Kurtosis of complex samples about zero: 0 for circular Gaussian noise, -1 for a tone, large for
/// a few strikes; 0 where there is no power.
///
///     K = <|z|⁴> / <|z|²>² - 2
///
/// Shape   N >= 1 → one, dimensionless. Errors  none thrown
/// Source  Antoni, Mech. Syst. Signal Process. 20(2), 282-307 (2006): spectral kurtosis
double complex_kurtosis(const Eigen::Ref<const Eigen::VectorXcd>& z);

/// Probability that so many independent samples of complex Gaussian noise show this kurtosis or
/// more.
///
/// Their powers over the sum of all are how uniform points part a line (Greenwood's statistic,
/// whose tail is that of its largest part), so the probability is taken given the largest power,
/// with the sum of the others by its first three moments, and weighed by how likely that is.
///
/// Limits  exact within a tenth from 1000 samples on, from 1e-4 up; with fewer it errs to the safe
///         side: at 100 and 1e-5 by a factor of 2, at 32 and 1e-3 by 4. Never below 1e-13.
/// Errors  throws std::invalid_argument: kurtosis not finite, samples below 2 or not finite
/// Source  Greenwood, J. R. Stat. Soc. 109(2), 85-110 (1946); Moran, J. R. Stat. Soc. B 9,
///         92-98 (1947)
double noise_kurtosis_p_value(double kurtosis, double samples);

/// How many independent samples of noise scatter their kurtosis like so many that are correlated,
/// as those of a coloured band are.
///
///     M / Σ |ρ(τ)|⁴
///
/// over all lags τ, as the fourth-order part of |z|⁴ correlates by |ρ|⁴.
/// @param power  of each spectral line of the samples, whose transform is their correlation ρ
/// @return at least 1, at most `samples`; `samples` where there is no power
/// Errors  none thrown. Source  ours: fourth moments of a complex Gaussian process by its second
double independent_samples(const Eigen::Ref<const Eigen::VectorXd>& power, double samples);

}  // namespace rvbench::analysis
