#pragma once

#include <Eigen/Core>
#include <vector>

namespace rvbench::analysis {

/// Middle value; the mean of the two middle ones if their number is even.
/// Units  those of the values. @throws std::invalid_argument if there is none. Source  definition
double median(std::vector<double> values);

/// Variance of the median of independent values, each of which has its own: π/2 times that of their
/// mean, which is taken by the middle one.
/// Units  those of the variances. @throws std::invalid_argument if there is none
/// Source  Kendall & Stuart, The Advanced Theory of Statistics 1, 14.12: of normal values
double variance_of_median(const std::vector<double>& variances);

/// The same value, found sooner between guess/1.5 and 1.5·guess. Units, errors, source  of median()
double median_near(double guess, std::vector<double> values);

/// Pearson correlation of two signals of one length; 0 if either is constant.
/// Units   none, -1 to 1. Errors  none thrown. Source  Pearson, Proc. R. Soc. 58, 240-242 (1895)
double correlation(const Eigen::Ref<const Eigen::VectorXd>& a,
                   const Eigen::Ref<const Eigen::VectorXd>& b);

/// Fourth standardised moment: 3 for Gaussian noise, 1.5 for a sine; 0 for a constant.
/// Shape   N >= 1 samples → one, dimensionless. Errors  none thrown
/// Source  Pearson, Biometrika 4, 169-212 (1905)
double kurtosis(const Eigen::Ref<const Eigen::VectorXd>& x);

/// Probability that `lines` noise lines together reach `statistic` = Σ power/floor or more, where
/// the floor itself was estimated from `floor_lines` independent noise lines.
///
/// Each line's power is exponentially distributed, so statistic/lines is F(2·lines, 2·floor_lines).
/// Errors  none thrown; a statistic not above 0 has p-value 1
/// Source  Percival & Walden, Spectral Analysis for Physical Applications (1993), ch. 10
double line_p_value(double statistic, double lines, double floor_lines);

/// Probability that |t| is this large or larger by chance, in Student's distribution.
/// @param freedom  degrees of freedom, > 0
/// Errors  none thrown. Source  Student, Biometrika 6(1), 1-25 (1908); as an incomplete beta
///         function: Abramowitz & Stegun (1964), sec. 26.5
double t_p_value(double t, double freedom);

/// The t that |t| exceeds by chance with this probability, in Student's distribution: 1.645 for 0.1
/// and many degrees of freedom.
/// @param p        in (0, 1)  @param freedom  >= 1
/// @throws std::invalid_argument if one is out of range
/// Source  t_p_value(), by bisection
double t_of_p_value(double p, double freedom);

/// Fisher's combination of independent p-values. Empty: 1.
/// Errors  none thrown; what is below 1e-300 counts as that
/// Source  Fisher, Statistical Methods for Research Workers (4th ed., 1932), §21.1
double combined_p_value(const std::vector<double>& p_values);

/// −ln of the probability that so many exponential numbers of mean 1, as −ln p by chance is, come
/// to this sum or more: combined_p_value() where it is too small for a double.
/// @param sum  > 0  @param count  >= 1
/// Errors  none thrown
/// Source  Abramowitz & Stegun (1964), eq. 26.4.21: with an even number of degrees of freedom the
///         tail of χ² is a finite series
double minus_log_gamma_tail(double sum, int count);

}  // namespace rvbench::analysis
