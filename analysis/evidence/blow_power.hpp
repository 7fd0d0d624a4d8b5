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

/// How deep blows are in one channel.
struct BlowDepth {
  double depth2 = not_known;  ///< squared; NaN where the channel has no envelope
  double variance = 0;        ///< of that, by noise; at most, as blows count as noise here
};

/// Depth of the blows that come `order` times per turn, in each channel.
/// Units   depth: rms of the blows times √2, over the root of reference_mean_square()
std::vector<BlowDepth> blow_depths(const std::vector<ResidualEnvelope>& channels,
                                   const Kinematics& kinematics, double order);

/// Median of blow_depths() over the channels that have an envelope, one at least; squared.
double median_depth2(const std::vector<BlowDepth>& depths);

/// How much the squared envelope of a channel swings over its mean at an order, 0-to-peak and
/// without noise: the strongest of the lines that slip may have spread it over. Lines of the gear
/// train count nothing.
double swing_at(const ResidualEnvelope& channel, double order);

/// Without those that are NaN.
double median_of_known(std::vector<double> values);

}  // namespace rvbench::analysis
