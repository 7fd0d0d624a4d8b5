#include "sim/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/types/units.hpp"
#include "sim/four_stage.hpp"
#include "sim/interpolation.hpp"
#include "sim/joint.hpp"
#include "sim/named.hpp"
#include "sim/plant_check.hpp"

namespace rvbench::sim {
namespace {

constexpr double most_substeps = 10000;

// Where one output comes from.
struct Sensor {
  OutputKind kind;
  std::size_t index;       // of the body, or of the term
  std::size_t prescribed;  // place among the prescribed bodies; their number if it moves freely
  Joint joint = {};        // that an effort passes
};

std::vector<Sensor> place_sensors(const PlantSpec& plant, const PlantModel& model) {
  std::vector<Sensor> sensors;
  for (const OutputSpec& output : plant.outputs) {
    const bool of_term = output.kind == OutputKind::effort;
    const int index =
        of_term ? index_of(plant.terms, output.of) : index_of(plant.bodies, output.of);
    const auto place = std::find(model.prescribed.begin(), model.prescribed.end(), index);
    sensors.push_back({output.kind, static_cast<std::size_t>(index),
                       static_cast<std::size_t>(place - model.prescribed.begin())});
    if (of_term) sensors.back().joint = Joint::at(model.terms, static_cast<std::size_t>(index));
  }
  return sensors;
}

// One run of a model along an excitation.
class Run {
 public:
  Run(const PlantSpec& plant, const PlantModel& model, const Excitation& excitation)
      : model_(model),
        excitation_(excitation),
        stepper_(model, 1 / (excitation.rate_Hz() * excitation.substeps())),
        sensors_(place_sensors(plant, model)),
        forces_(Eigen::VectorXd::Zero(model.inertia.size())) {
    for (std::vector<double>& stage : si_) stage.resize(model.taps.size());
    needs_forces_ = std::any_of(sensors_.begin(), sensors_.end(), [](const Sensor& sensor) {
      return sensor.kind == OutputKind::acceleration || sensor.kind == OutputKind::drive;
    });
    for (const OutputSpec& output : plant.outputs) {
      channels_.push_back({{output.channel, output.unit, "", not_known},
                           excitation.rate_Hz(),
                           excitation.start_s(),
                           Eigen::VectorXd(excitation.samples())});
    }
  }

  // @return how many samples it stayed within bounds
  Eigen::Index go() {
    tap(0, 0, 0);
    stepper_.start(si_[0].data());
    sense(0);
    const Eigen::Index substeps = excitation_.substeps();
    for (Eigen::Index sample = 1; sample < excitation_.samples(); ++sample) {
      for (Eigen::Index i = 0; i < substeps; ++i) {
        const Eigen::Index step = (sample - 1) * substeps + i;
        for (int stage = 0; stage < 3; ++stage) tap(step, stage, std::size_t(stage));
        stepper_.step(si_[0].data(), si_[1].data(), si_[2].data());
      }
      if (!stepper_.in_bounds()) return sample;
      sense(sample);
    }
    return excitation_.samples();
  }

  std::vector<Channel> take_channels() { return std::move(channels_); }

 private:
  void tap(Eigen::Index step, int stage, std::size_t into) {
    const double* columns = excitation_.at(step, stage);
    const double t_s = (static_cast<double>(step) + 0.5 * stage) * step_s_;
    for (std::size_t i = 0; i < model_.taps.size(); ++i) {
      const SignalTap& t = model_.taps[i];
      si_[into][i] = t.gain * columns[t.column] + t.offset + t.ramp_per_s * t_s;
    }
  }

  void sense(Eigen::Index sample) {
    if (needs_forces_) stepper_.forces(forces_);
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      channels_[i].samples[sample] = value_of(sensors_[i]);
    }
  }

  double value_of(const Sensor& sensor) const {
    const auto body = static_cast<Eigen::Index>(sensor.index);
    const PlantState& s = stepper_.state();
    switch (sensor.kind) {
      case OutputKind::position: return s.q[body];
      case OutputKind::speed: return s.v[body];
      case OutputKind::acceleration:
        return sensor.prescribed < model_.prescribed.size()
                   ? stepper_.prescribed_acceleration(sensor.prescribed)
                   : forces_[body] / model_.inertia[body];
      case OutputKind::effort: return sensor.joint.passed(s);
      case OutputKind::drive:
        return model_.inertia[body] * stepper_.prescribed_acceleration(sensor.prescribed) -
               forces_[body];
    }
    return not_known;
  }

  const PlantModel& model_;
  const Excitation& excitation_;
  FourStage stepper_;
  double step_s_ = 1 / (excitation_.rate_Hz() * excitation_.substeps());
  std::vector<Sensor> sensors_;
  bool needs_forces_ = false;
  Eigen::VectorXd forces_;
  std::array<std::vector<double>, 3> si_;
  std::vector<Channel> channels_;
};

void add_hum(const Hum& hum, Channel& channel) {
  const double radians_per_sample = units::two_pi * hum.frequency.value / channel.rate_Hz;
  const double turns_before = std::fmod(hum.frequency.value * channel.start_s, 1);
  const double at_start_rad = hum.phase.value + units::two_pi * turns_before;
  for (Eigen::Index i = 0; i < channel.samples.size(); ++i) {
    const double turned_rad = radians_per_sample * static_cast<double>(i);
    channel.samples[i] += hum.amplitude.value * std::cos(turned_rad + at_start_rad);
  }
}

// channel(t) = gain·x(t − delay) + offset
void scale_and_delay(const OutputSpec& output, Channel& channel) {
  if (output.delay.value != 0) {
    const double samples = -output.delay.value * channel.rate_Hz;
    const double whole = std::floor(samples);
    const Interpolation at(0, samples - whole);
    const Eigen::VectorXd x = channel.samples;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      channel.samples[i] = at(x, i + static_cast<Eigen::Index>(whole));
    }
  }
  channel.samples = output.gain.value * channel.samples.array() + output.offset.value;
}

}  // namespace

std::variant<int, hal::ConfigFault> substeps_for(const PlantSpec& plant, double rate_Hz,
                                                 const TermLibrary& library) {
  const auto made = make_model(plant, library);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) return *fault;
  const double wanted = substeps_wanted(std::get<PlantModel>(made), rate_Hz);
  if (!(wanted <= most_substeps)) {
    return hal::ConfigFault{
        0, "/terms", fmt::format("too stiff: {:g} steps per sample would be needed", wanted)};
  }
  return std::max(static_cast<int>(wanted), substeps_of_inputs(plant));
}

SimulatedOrFault simulate(const PlantSpec& plant, const Excitation& excitation,
                          const TermLibrary& library) {
  const auto made = make_model(plant, library);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) return *fault;
  const auto& model = std::get<PlantModel>(made);
  Run run(plant, model, excitation);
  const Eigen::Index reached = run.go();
  if (reached < excitation.samples()) {
    return hal::ConfigFault{
        0, "/terms",
        fmt::format("unstable: a body leaves all bounds {:.6g} s after the start",
                    static_cast<double>(reached) / excitation.rate_Hz())};
  }
  Simulated result{run.take_channels(), excitation.substeps(),
                   substeps_wanted(model, excitation.rate_Hz())};
  for (std::size_t i = 0; i < plant.outputs.size(); ++i) {
    Channel& channel = result.channels[i];
    if (!channel.samples.allFinite()) {
      return hal::ConfigFault{0, fmt::format("/outputs/{}", i), "does not stay finite"};
    }
    scale_and_delay(plant.outputs[i], channel);
    for (std::size_t h = 0; h < plant.outputs[i].hums.size(); ++h) {
      const Hum& hum = plant.outputs[i].hums[h];
      if (2 * hum.frequency.value >= channel.rate_Hz) {
        return hal::ConfigFault{0, fmt::format("/outputs/{}/hums/{}/frequency", i, h),
                                fmt::format("{:g} Hz would show as another frequency at {:g} "
                                            "samples a second",
                                            hum.frequency.value, channel.rate_Hz)};
      }
      add_hum(hum, channel);
    }
  }
  return result;
}

SimulatedOrFault simulate(const PlantSpec& plant, const std::vector<Channel>& inputs,
                          const TermLibrary& library) {
  const Channel* first =
      plant.inputs.empty() ? nullptr : find_channel(inputs, plant.inputs.front().channel);
  const double rate_Hz = first == nullptr ? 0 : first->rate_Hz;
  const auto substeps = substeps_for(plant, rate_Hz > 0 ? rate_Hz : 1e3, library);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&substeps)) return *fault;
  const auto excitation = Excitation::make(plant, inputs, std::get<int>(substeps));
  if (const auto* fault = std::get_if<hal::ConfigFault>(&excitation)) return *fault;
  return simulate(plant, std::get<Excitation>(excitation), library);
}

}  // namespace rvbench::sim
