#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/residual_envelope.hpp"

namespace rvbench::analysis {

/// Harmonics of a train of blows that are asked for.
inline constexpr int blow_harmonics = 4;

/// Relative: slip that wanders spreads a line of blows by it.
inline constexpr double blow_smear = 0.002;

/// The share of a train's mean power that one harmonic of its squared envelope holds. Blows ring
/// down and jitter, and each of their lines passes the housing in its own phase.
/// @param harmonic  1 to blow_harmonics
/// Source  ours
double of_mean_power(int harmonic);

/// Mean square that the severity of blows refers to: that of the gears, or of the whole signal of a
/// machine without meshes.
double reference_mean_square(const ResidualEnvelope& channel, const Kinematics& kinematics);

/// Swing of the squared envelope over its mean, where blows of a severity are in what is left.
double swing_by(double severity, const ResidualEnvelope& channel, const Kinematics& kinematics);

/// Squared depth of blows `order` times per turn in each channel; NaN where it has no envelope.
/// Units   depth: rms of the blows times √2, over the root of reference_mean_square()
std::vector<double> blow_depths2(const std::vector<ResidualEnvelope>& channels,
                                 const Kinematics& kinematics, double order);

/// Without those that are NaN.
double median_of_known(std::vector<double> values);

}  // namespace rvbench::analysis
