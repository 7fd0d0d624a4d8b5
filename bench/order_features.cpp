#include "bench/order_features.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/shaft_angle.hpp"
#include "bench/channel_fault.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

constexpr double main_lobe = 2;  // lines, to each side of a Hann window's
constexpr double on_a_line = 1e-6;

// The part of a line that a Hann window passes so many lines beside it.
// Source  Harris, Proc. IEEE 66(1), 51-83 (1978)
double passed(double lines_beside) {
  const double x = std::abs(lines_beside);
  if (x >= main_lobe) return 0;
  if (x < on_a_line) return 1;
  if (std::abs(x - 1) < on_a_line) return 0.5;
  return std::sin(std::numbers::pi * x) / (std::numbers::pi * x * (1 - x * x));
}

}  // namespace

std::variant<Eigen::VectorXd, hal::ConfigFault> steady_inputs(const sim::PlantSpec& plant,
                                                              const Recording& recording) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(plant.inputs.size()));
  for (std::size_t i = 0; i < plant.inputs.size(); ++i) {
    const Channel* channel = recording.find(plant.inputs[i].channel);
    if (channel != nullptr && !channel->info.unit.empty() &&
        channel->info.unit != plant.inputs[i].unit) {
      return hal::ConfigFault{
          0, fmt::format("/inputs/{}/channel", i),
          fmt::format("{} is in {}, the plant takes {}", hal::in_quotes(plant.inputs[i].channel),
                      channel->info.unit, plant.inputs[i].unit)};
    }
    const double value = channel == nullptr ? not_known : channel->samples.mean();
    if (!std::isfinite(value)) {
      return hal::ConfigFault{0, fmt::format("/inputs/{}/channel", i),
                              hal::in_quotes(plant.inputs[i].channel) + " [" +
                                  plant.inputs[i].unit + "] is not told by the recording"};
    }
    values[static_cast<Eigen::Index>(i)] = value;
  }
  return values;
}

std::variant<OrderMeasurement, std::string> measure_orders(const sim::PlantSpec& plant,
                                                           const Recording& recording,
                                                           std::size_t angle, double period_turns) {
  for (const sim::OutputSpec& output : plant.outputs) {
    const bool is_angle = &output == &plant.outputs[angle];
    const std::string fault = channel_fault(recording, output);
    if (!fault.empty() && !(is_angle && recording.find(output.channel) != nullptr)) return fault;
  }
  const auto shaft = analysis::ShaftAngle::of(recording);
  if (!shaft || !shaft->is_measured()) return std::string("the shaft does not turn");
  OrderMeasurement measured;
  measured.speed_Hz = shaft->mean_speed_Hz();
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    if (o == angle) {
      analysis::PeriodLines speed;
      speed.mean = units::two_pi * measured.speed_Hz;
      measured.outputs.push_back(std::move(speed));
      continue;
    }
    const Channel& channel = *recording.find(plant.outputs[o].channel);
    auto lines = analysis::period_lines(channel, *shaft, period_turns);
    if (!lines) {
      return fmt::format("shorter than four periods of {:g} turns: lines cannot be parted",
                         period_turns);
    }
    measured.length_s = static_cast<double>(channel.samples.size()) / channel.rate_Hz;
    measured.outputs.push_back(*std::move(lines));
  }
  return measured;
}

std::complex<double> predicted(const sim::SteadyState& state, const OrderFeature& feature,
                               double length_s) {
  const sim::SteadyOutput& output = state.outputs[feature.output];
  switch (feature.locked_to) {
    case analysis::LockedTo::nothing: return output.mean;
    case analysis::LockedTo::shaft: return output.shaft_lines[feature.order];
    case analysis::LockedTo::time:
    case analysis::LockedTo::programme: break;
  }
  std::complex<double> line = 0;
  for (std::size_t i = 0; i < state.rhythms_Hz.size(); ++i) {
    const bool is_same = !feature.slip_of.empty() && state.slip_of[i] == feature.slip_of;
    const double beside_Hz = is_same ? 0 : state.rhythms_Hz[i] - feature.frequency_Hz;
    line += passed(beside_Hz * length_s) * output.timed_lines[static_cast<Eigen::Index>(i)];
  }
  // At some speeds a line of the shaft has that frequency too.
  const auto order = static_cast<Eigen::Index>(std::round(feature.frequency_Hz / state.period_Hz));
  const double beside_Hz = static_cast<double>(order) * state.period_Hz - feature.frequency_Hz;
  if (order > 0 && order < output.shaft_lines.size()) {
    line += passed(beside_Hz * length_s) * output.shaft_lines[order];
  }
  return line;
}

double with_noise(double amplitude, double noise) {
  return std::hypot(amplitude, std::sqrt(std::numbers::pi) / 2 * noise);
}

}  // namespace rvbench::bench
