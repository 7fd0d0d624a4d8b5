#pragma once

#include <Eigen/Core>

#include "analysis/order/over_angle.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Amplitude spectrum over orders of a shaft, of all that was sampled over its angle.
///
/// Shape    N samples → N/2 + 1 lines, one per 1 / (turns spanned); orders above 0.4 of
///          samples_per_turn are aliases or damped
/// Units    that of the samples, 0-to-peak: a sine of amplitude a on a line reads a. Hann window;
///          the mean is taken out first and is line 0
/// Limits   between two lines a tone reads up to 1.42 dB low
/// Errors   throws std::invalid_argument: fewer than 2 samples, a sample not finite
/// Source   Fyfe & Munck, Mech. Syst. Signal Process. 11(2), 187-205 (1997)
Spectrum order_spectrum(const OverAngle& x);

/// The same of x, taken at rate_Hz from start_s on, over as many whole turns as fit, with as many
/// samples as there were in time: its band keeps its room.
///
/// Shape, units, limits, source  as above
/// Errors   throws std::invalid_argument: x holds no whole turn, or as over_angle() has them
Spectrum order_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz, double start_s,
                        const ShaftAngle& angle);

}  // namespace rvbench::analysis
