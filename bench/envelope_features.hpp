#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/squared_envelope.hpp"
#include "sim/plant_spec.hpp"
#include "sim/random_vibration.hpp"

namespace rvbench::bench {

/// One stretch of a record by which a random vibration is compared, output by output.
using VibrationBlock = std::vector<analysis::BandVibration>;

/// Parts that an output's band is cut into for its levels.
inline constexpr Eigen::Index level_parts = 24;

/// Where the plant is solved within an output's band.
sim::FrequencyBand solved_band(const sim::OutputSpec& output);

/// Levels of the parts of the band, dB re (1 unit)².
Eigen::VectorXd levels_dB(const Eigen::VectorXd& mean_square);
/// The same of a vibration that was solved over solved_band().
Eigen::VectorXd mean_square_of(const sim::Vibration& vibration, const sim::FrequencyBand& band);

/// How deep the squared envelope swells near a frequency, of all swells there.
double depth_of(const sim::Vibration& vibration, double frequency_Hz, double within_Hz);

inline constexpr double turns_per_block = 10;  ///< of the shaft

/// How far a line may stray from its frequency: rolling elements slip.
double slip_width_Hz(double frequency_Hz);
/// Within how much of a frequency a stretch shows one line only: its slip, or two lines of the
/// stretch's spectrum.
double line_width_Hz(double frequency_Hz, double shaft_Hz);

/// Frequencies of a plant's swells and of those that its candidates would bring, over the shaft's:
/// one for lines that cannot be told apart.
/// @param shown  vibrations of one output, of usual size
/// @param shaft_Hz  what they are orders of
std::vector<double> orders_of_swells(const std::vector<sim::Vibration>& shown, double shaft_Hz);

/// A solved squared envelope over the lines of a measured one: its swells where the highest lines
/// within their slip are, each as wide as a Hann window makes it, among what noise shows.
Eigen::VectorXd drawn_depth(const sim::Vibration& shown, const analysis::Spectrum& measured);

}  // namespace rvbench::bench
