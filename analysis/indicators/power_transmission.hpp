#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::analysis {

/// Torque ripple: the range of a torque over the magnitude of its mean.
///
/// Shape   N >= 1 samples, over whole periods of what makes them swing
/// Units   N·m → dimensionless; 2a/T for a sine of amplitude a about a mean of T
/// Limits  noise widens the range with the length of the record: compare like with like
/// @return empty where the mean is 0
/// Errors  throws std::invalid_argument: N < 1, sample not finite
/// Source  Jahns & Soong, IEEE Trans. Ind. Electron. 43(2), 321-330 (1996)
std::optional<double> torque_ripple(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm);

/// Mean power that a shaft hands over: <torque·speed>.
///
/// Units   N·m, rad/s → W; positive where torque and speed have one sign
/// Errors  throws std::invalid_argument: none or different numbers of samples, sample not finite
/// Source  definition of mechanical power; not <torque>·<speed>, which leaves out what both share
double mean_power_W(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm,
                    const Eigen::Ref<const Eigen::VectorXd>& speed_rad_s);

/// Efficiency of a transmission: power that leaves it over power that enters.
///
/// Both powers are positive as they pass from input to output; with both negative the output
/// drives, and the efficiency is that of being driven. Above 1 where the sensors disagree: it is
/// not cut off.
///
/// Units   W → dimensionless
/// @return empty where neither side drives the other: powers of different signs, or one is 0 or not
///         finite
/// Source  ISO/TR 14179-1:2001, overall efficiency
std::optional<double> efficiency(double input_power_W, double output_power_W);

}  // namespace rvbench::analysis
