#pragma once

#include <Eigen/Core>

#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// A signal at even steps of a shaft's angle, over whole periods.
struct OverAngle {
  Eigen::VectorXd samples;   ///< in the unit of the signal
  int samples_per_turn = 0;  ///< highest order held: 0.4 of it
  double first_turns = 0;    ///< of the angle, at samples[0]
};

/// Where even steps are to lie.
struct EvenSteps {
  int samples_per_turn = 1024;
  double period_turns = 1;  ///< turns per period; their product with samples_per_turn is whole
};

/// Samples x, taken at rate_Hz from start_s on, anew at even steps of a shaft's angle.
///
/// Shape    N samples → whole periods · period_turns · samples_per_turn; empty if no period fits
/// Units    those of x
/// Band     what lies below 0.4 of both rates, rate_Hz and samples_per_turn · speed, keeps its
///          amplitude to 2e-5; what lies above 0.6 of the lower one is 90 dB down. So an order up
///          to 0.4 · samples_per_turn is its own and no alias, at whatever speed
/// Limits   an angle that is off by δ turns puts an error of 2π·order·δ of the amplitude on a line;
///          half the filter's length at both ends, 32 samples of the slower rate, sees the end
/// Errors   throws std::invalid_argument: steps not above 0, their product not whole, rate_Hz not
///          positive, a sample not finite
/// Source   Fyfe & Munck, Mech. Syst. Signal Process. 11(2), 187-205 (1997): computed order
///          tracking, and why its filter must follow the speed
OverAngle over_angle(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz, double start_s,
                     const ShaftAngle& angle, const EvenSteps& steps);

}  // namespace rvbench::analysis
