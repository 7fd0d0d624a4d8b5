#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "analysis/explain/period_lines.hpp"
#include "analysis/explain/residual_cells.hpp"
#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"
#include "sim/plant_spec.hpp"
#include "sim/steady_state.hpp"

namespace rvbench::bench {

/// One number that a record of a steadily turning plant is compared by.
struct OrderFeature {
  /// The mean of the output, and of the shaft's angle its speed; or the amplitude of the line of
  /// this order of the period, or at this frequency.
  analysis::LockedTo locked_to = analysis::LockedTo::nothing;
  std::size_t output = 0;
  int order = 0;  ///< of what follows time its number, the same under all conditions
  double frequency_Hz = 0;
  /// The motor at twice whose slip frequency the line is, as measured: each record has it at its
  /// own, the plant too. frequency_Hz is that of the mean speed. "": of none
  std::string slip_of = {};
};

/// Values of a plant's inputs during a steady record, in order of its inputs: the mean of the
/// channel, or what was planned (see planned_inputs()).
/// @return a fault at the input that the record does not tell
std::variant<Eigen::VectorXd, hal::ConfigFault> steady_inputs(const sim::PlantSpec& plant,
                                                              const Recording& recording);

/// What a record shows, output by output.
struct OrderMeasurement {
  std::vector<analysis::PeriodLines> outputs;  ///< in order of the plant's; that of the angle has
                                               ///< its speed [rad/s] for a mean, and no lines
  double length_s = 0;
  double speed_Hz = 0;  ///< of the shaft that the angle is of
};

/// @param angle         output that is the shaft's angle
/// @param period_turns  turns of that shaft per period
/// @return why it cannot be compared: channels missing, too short, not turning
std::variant<OrderMeasurement, std::string> measure_orders(const sim::PlantSpec& plant,
                                                           const Recording& recording,
                                                           std::size_t angle, double period_turns);

/// What a record shows of a feature of the plant: the mean, or the complex line. Of a line that
/// follows time, what a Hann window over the record passes of all that lie beside it.
std::complex<double> predicted(const sim::SteadyState& state, const OrderFeature& feature,
                               double length_s);

/// What a measurement shows on average of this amplitude among noise of this rms amplitude.
/// Source  Rice, Bell Syst. Tech. J. 24, 46-156 (1945): its ends are exact, 2 % off between
double with_noise(double amplitude, double noise);

}  // namespace rvbench::bench
