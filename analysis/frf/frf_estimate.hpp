#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "analysis/frf/cross_spectra.hpp"
#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// Which channel is thought to be noisy.
enum class FrfEstimator {
  h1,  ///< the response: least squares. Noise of the excitation makes it too small
  h2,  ///< the excitation. Noise of the response makes it too large; one excitation only
  hv   ///< both, each as much as its power: total least squares
};

/// A frequency response and how sure it is.
struct EstimatedResponse {
  FrequencyResponse response;      ///< its coherence is the multiple one if there are several
                                   ///< excitations; empty where averages do not suffice to tell
  Eigen::VectorXd standard_error;  ///< per line, of real and of imaginary part, and so of |H|;
                                   ///< over |H| it is that of the phase in rad. NaN: not known
  double freedom = 0;              ///< averages beyond the number of excitations
};

/// What was estimated of all pairs, and whether the excitations could be told apart.
struct FrfEstimates {
  std::vector<EstimatedResponse> responses;  ///< R·E: all excitations of response 0, then of 1 ...
  Eigen::VectorXd independence;  ///< per line: smallest eigenvalue of the excitations' matrix of
                                 ///< coherence, 1 if uncorrelated, 0 if one follows from others
};

/// Frequency responses by averaging.
///
///     H1 = Gyx·Gxx⁻¹     H2 = Gyy / Gxy     Hv: of the smallest eigenvector of all channels'
///     γ² = Gyx·Gxx⁻¹·Gxy / Gyy              matrix, each channel scaled to power 1 in the line
///     standard error² = (1 - γ²)·Gyy·[Gxx⁻¹]ᵢᵢ / (2·(n - E))
///
/// For one excitation that is |H|²·(1 - γ²) / (2·γ²·(n - 1)). Hv is then the geometric mean of H1
/// and H2, with the phase of both. H2 and Hv are given the relative error of H1, which is a little
/// more than the magnitude of Hv has: (1 - γ²) / (2·n).
///
/// Shape   lines of `spectra`
/// Units   those of the setup
/// Errors  throws std::invalid_argument: setup and spectra differ in channels, H2 of several
///         excitations. A line whose excitations cannot be told apart, or are silent, is NaN, and
///         a note says how many there are
/// Limits  the error is random error only: leakage, a nonlinear structure or a hammer that turns
///         lower the coherence too, but bias the response. Coherence is biased upward by about
///         (1 - γ²)²/n
/// Source  Bendat & Piersol, Random Data (4th ed., 2010), sec. 7.3, 9.2-9.3; Rocklin, Crowley &
/// Vold,
///         Proc. 3rd IMAC, 272-278 (1985) for Hv
FrfEstimates estimate_responses(const CrossSpectra& spectra, const FrfSetup& setup,
                                FrfEstimator estimator, const std::string& source);

/// Around each line of an estimate lies the true response within this radius, in the complex plane,
/// with probability 1 - p: radius² = 2·s²·m·(p^(-1/m) - 1) for standard error s and m degrees of
/// freedom, which is F with 2 and 2m in closed form.
/// Shape   lines. Units  of the response
/// Errors  throws std::invalid_argument: p not within 0 and 1. NaN where the error is not known
/// Source  Bendat & Piersol, Random Data (4th ed., 2010), sec. 9.2.4
Eigen::VectorXd confidence_radius(const EstimatedResponse& estimate, double p);

/// "H1", "H2", "Hv"
const char* to_string(FrfEstimator estimator) noexcept;

}  // namespace rvbench::analysis
