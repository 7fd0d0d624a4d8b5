#include "sim/excitation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hal/did_you_mean.hpp"
#include "sim/interpolation.hpp"
#include "sim/plant_model.hpp"

namespace rvbench::sim {
namespace {

// Why this channel cannot be used, or "".
std::string channel_fault(const Channel& channel, const InputSpec& input, const Channel& first) {
  const std::string name = hal::in_quotes(input.channel);
  if (!channel.info.unit.empty() && channel.info.unit != input.unit) {
    return fmt::format("channel {} is in {}, the plant expects {}", name,
                       hal::in_quotes(channel.info.unit), hal::in_quotes(input.unit));
  }
  if (!(channel.rate_Hz > 0)) return "the rate of channel " + name + " is not known";
  if (channel.samples.size() < 2) return "channel " + name + " has fewer than 2 samples";
  if (channel.rate_Hz != first.rate_Hz || channel.samples.size() != first.samples.size() ||
      std::abs(channel.start_s - first.start_s) * channel.rate_Hz > 0.01) {
    return fmt::format("channel {} and channel {} differ in rate, length or start", name,
                       hal::in_quotes(first.info.name));
  }
  const Eigen::Index lost = (!channel.samples.array().isFinite()).count();
  if (lost > 0) return fmt::format("channel {} has {} samples that are not finite", name, lost);
  return {};
}

}  // namespace

int substeps_of_inputs(const PlantSpec& plant) {
  for (const InputSpec& input : plant.inputs) {
    if (input.kind < InputKind::position && input.between == Between::band_limited) return 4;
  }
  return 1;
}

std::variant<Excitation, hal::ConfigFault> Excitation::make(const PlantSpec& plant,
                                                            const std::vector<Channel>& channels,
                                                            int substeps) {
  if (substeps < 1) throw std::invalid_argument("Excitation: substeps must be > 0");
  Excitation made;
  made.substeps_ = substeps;
  const Channel* first = nullptr;
  std::vector<const Channel*> found;
  for (std::size_t i = 0; i < plant.inputs.size(); ++i) {
    const InputSpec& input = plant.inputs[i];
    const std::string pointer = fmt::format("/inputs/{}/channel", i);
    const Channel* channel = find_channel(channels, input.channel);
    if (channel == nullptr) {
      std::vector<std::string> names;
      for (const Channel& other : channels) names.push_back(other.info.name);
      return hal::ConfigFault{0, pointer,
                              "the recording has no channel " + hal::in_quotes(input.channel) +
                                  hal::did_you_mean(input.channel, names)};
    }
    if (first == nullptr) first = channel;
    const std::string fault = channel_fault(*channel, input, *first);
    if (!fault.empty()) return hal::ConfigFault{0, pointer, fault};
    found.push_back(channel);
    made.columns_ += columns_of(input.kind);
  }
  if (first == nullptr) return hal::ConfigFault{0, "/inputs", "needs at least one input"};

  made.samples_ = first->samples.size();
  made.rate_Hz_ = first->rate_Hz;
  made.start_s_ = first->start_s;
  made.values_.resize(static_cast<std::size_t>(3 * (made.samples_ - 1) * substeps * made.columns_));
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const InputSpec& input = plant.inputs[i];
    if (input.kind < InputKind::position || input.kind == InputKind::acceleration) {
      made.fill_between(found[i]->samples, input.between, column);
    } else {
      made.fill_motion(found[i]->samples, input, column);
    }
    column += columns_of(input.kind);
  }
  return made;
}

// @param half  half steps after the sample, 0 .. 2·substeps − 1
// @param at_end  the same instant, as the end of the step before
double& Excitation::value(Eigen::Index sample, int half, Eigen::Index column, bool at_end) {
  const Eigen::Index halves = 2 * sample * substeps_ + half;
  const Eigen::Index step = at_end ? halves / 2 - 1 : halves / 2;
  const Eigen::Index stage = at_end ? 2 : halves % 2;
  return values_[static_cast<std::size_t>((3 * step + stage) * columns_ + column)];
}

void Excitation::fill_curve(const Eigen::VectorXd& x, int derivative, double cutoff, double scale,
                            Eigen::Index column) {
  for (int half = 0; half < 2 * substeps_; ++half) {
    const Interpolation at(derivative, half / (2.0 * substeps_), cutoff);
    const bool plain = derivative == 0 && half == 0 && cutoff == 0.5;
    for (Eigen::Index i = 0; i < samples_; ++i) {
      if (i + 1 == samples_ && half > 0) break;
      const double sought = scale * (plain ? x[i] : at(x, i));
      if (i + 1 < samples_) value(i, half, column, false) = sought;
      if (half % 2 == 0 && i + half > 0) value(i, half, column, true) = sought;
    }
  }
}

void Excitation::fill_between(const Eigen::VectorXd& x, Between between, Eigen::Index column) {
  if (between == Between::band_limited) return fill_curve(x, 0, 0.5, 1, column);
  for (Eigen::Index i = 0; i + 1 < samples_; ++i) {
    for (int j = 0; j < substeps_; ++j) {
      for (int stage = 0; stage < 3; ++stage) {
        const double share = between == Between::hold ? 0 : (j + 0.5 * stage) / substeps_;
        values_[static_cast<std::size_t>((3 * (i * substeps_ + j) + stage) * columns_ + column)] =
            x[i] + share * (x[i + 1] - x[i]);
      }
    }
  }
}

// A position: itself, speed, acceleration. A speed: its integral, itself, acceleration.
void Excitation::fill_motion(const Eigen::VectorXd& x, const InputSpec& input,
                             Eigen::Index column) {
  const double cutoff = std::min(input.band_Hz / rate_Hz_, 0.5);
  const bool position = input.kind == InputKind::position;
  fill_curve(x, 0, cutoff, 1, position ? column : column + 1);
  fill_curve(x, 1, cutoff, rate_Hz_, position ? column + 1 : column + 2);
  if (position) return fill_curve(x, 2, cutoff, rate_Hz_ * rate_Hz_, column + 2);
  double integral = 0;
  const double step_s = 1 / (rate_Hz_ * substeps_);
  for (Eigen::Index step = 0; step < (samples_ - 1) * substeps_; ++step) {
    double* stages = values_.data() + 3 * step * columns_ + column;
    const double v0 = stages[1], v1 = stages[columns_ + 1], v2 = stages[2 * columns_ + 1];
    stages[0] = integral;
    stages[columns_] = integral + step_s / 24 * (5 * v0 + 8 * v1 - v2);
    integral += step_s / 6 * (v0 + 4 * v1 + v2);
    stages[2 * columns_] = integral;
  }
}

}  // namespace rvbench::sim
