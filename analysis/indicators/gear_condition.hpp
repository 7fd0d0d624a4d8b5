#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace rvbench::analysis {

/// FM0, of faults that are heard at the mesh as a whole: how much higher than its mesh lines the
/// average of one gear swings.
///
///     FM0 = peak to peak / Σ amplitudes of mesh harmonics 1 .. harmonics
///
/// Shape   average: N samples, even in shaft angle, over whole turns of the gear: its
///         time-synchronous average
/// Units   dimensionless; 2 for a mesh that is one sine
/// @param mesh_line  line of the mesh in the spectrum of `average`: teeth times turns
/// @return empty where the mesh has no amplitude
/// Errors  throws std::invalid_argument: a harmonic is not below N/2, harmonics or line < 1, sample
///         not finite
/// Source  Stewart, Some useful data analysis techniques for gearbox diagnostics (1977); Lebold et
///         al., Proc. 54th Meeting MFPT, 623-634 (2000)
std::optional<double> fm0(const Eigen::Ref<const Eigen::VectorXd>& average, Eigen::Index mesh_line,
                          int harmonics);

/// FM4, of faults of one or two teeth: kurtosis of what the average keeps when mesh harmonics and
/// their first sidebands are taken out.
///
/// Shape   difference: N samples; the caller takes the lines out
/// Units   dimensionless; 3 for Gaussian noise, more for a tooth that stands out; 0 for a constant
/// Errors  none thrown. Source  Stewart (1977); Lebold et al. (2000)
double fm4(const Eigen::Ref<const Eigen::VectorXd>& difference);

/// How a residual swings: what NA4 asks of it, now and of earlier records.
struct ResidualMoments {
  double variance = 0;       ///< <(r - <r>)²>, in its unit squared
  double fourth_moment = 0;  ///< <(r - <r>)⁴>, in the unit of variance squared
};

/// Shape   residual: N samples of the average without mesh harmonics, sidebands kept
/// Errors  throws std::invalid_argument: N < 1, sample not finite
ResidualMoments residual_moments(const Eigen::Ref<const Eigen::VectorXd>& residual);

/// NA4, as FM4 for faults that spread, which keeps growing when all teeth are bad: the fourth
/// moment against the mean variance of all records of the gear so far, not of this one alone.
///
///     NA4 = <(r - <r>)⁴> / (mean of the variances so far)²
///
/// Units   dimensionless; 3 for Gaussian noise of constant variance
/// @param earlier_variances  of the residuals of earlier records, in the unit of r squared; with
///                           none NA4 is the kurtosis
/// @return empty where nothing has swung
/// Errors  throws std::invalid_argument: a variance or moment negative or not finite
/// Source  Zakrajsek, Townsend & Decker, NASA TM-105950 (1993); Lebold et al. (2000)
std::optional<double> na4(const ResidualMoments& now, const std::vector<double>& earlier_variances);

}  // namespace rvbench::analysis
