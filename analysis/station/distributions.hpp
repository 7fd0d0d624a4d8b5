#pragma once

namespace rvbench::analysis {

/// Probabilities are of a value that small or smaller, quantiles what such a probability belongs
/// to. Source of all: Abramowitz & Stegun (1964), ch. 26; quantiles by bisection.

/// Of the normal distribution of mean 0 and variance 1. Errors  none thrown
double normal_probability(double z);

/// @throws std::invalid_argument if the probability is not within (0, 1)
double normal_quantile(double probability);

/// Of chi-square. @param freedom  degrees of freedom, > 0. Errors  none thrown; 0 for x below 0
double chi_square_probability(double x, double freedom);

/// @throws std::invalid_argument if the probability is not within (0, 1), or freedom not above 0
double chi_square_quantile(double probability, double freedom);

/// Probability of an F this large or larger by chance, of a ratio of two mean squares.
/// @param above, below  degrees of freedom of what is above and below the line, > 0
/// Errors  none thrown; an F not above 0 has p-value 1
double f_p_value(double f, double above, double below);

/// @throws std::invalid_argument if the probability is not within (0, 1), or a freedom not above 0
double f_quantile(double probability, double above, double below);

}  // namespace rvbench::analysis
