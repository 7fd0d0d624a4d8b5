#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::analysis {

/// Lines of several frequency responses around some resonances.
struct FitBand {
  double first_Hz = 0, step_Hz = 1;
  Eigen::MatrixXcd values;  ///< L lines x K responses, finite
};

/// Poles that all responses of a band have in common.
struct PoleFit {
  Eigen::VectorXcd poles_rad_s;  ///< -σ + jω√(1-ζ²) of each; σ > 0 is not demanded
  Eigen::VectorXd
      errors_rad_s;             ///< standard error of real and imaginary part, by what is left over
  Eigen::MatrixXcd residues;    ///< poles x K: the response holds residue / (jω - pole)
  Eigen::VectorXd heights;      ///< per pole: norm over all responses of its part at its own peak
  Eigen::VectorXd backgrounds;  ///< and of everything else there
  double left_over = 0;         ///< Σ |measured - fitted|², unit of the values squared
  double freedom = 0;           ///< complex numbers that are left to tell that, >= 1
};

/// Least squares of a few poles, common to all responses, in a narrow band:
///
///     Hₖ(ω) = Σᵢ residueᵢₖ / (jω - poleᵢ) + c0ₖ + c1ₖ·ω
///
/// The straight line stands for all modes outside. Weighted so that what is minimised is the
/// difference of responses (Sanathanan & Koerner), with the fitted responses as instruments, so
/// that noise does not broaden the resonances. With no pole it is the straight line alone.
///
/// Shape   L >= poles + 4 lines
/// Units   Hz, rad/s
/// @return nothing where the iteration does not settle within 50 steps
/// Errors  throws std::invalid_argument: too few lines, step not above 0, no response, values not
///         finite
/// Limits  noise is taken as white over the lines and equal in all responses
/// Source  Sanathanan & Koerner, IEEE Trans. Autom. Control 8, 56-58 (1963); Young, Automatica 17,
///         595-611 (1981) for instruments; Richardson & Formenti, Proc. 1st IMAC, 167-181 (1982)
std::optional<PoleFit> fit_poles(const FitBand& band, int poles);

}  // namespace rvbench::analysis
