#include "tests/support/rv_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "bench/planned_inputs.hpp"
#include "sim/draw.hpp"
#include "sim/plant_model.hpp"
#include "sim/rv_train.hpp"

namespace rvbench::test {
namespace {

constexpr double daq_rate_Hz = 4960;
constexpr double steps_per_wanted = 8;  // a mode that turns by 2 rad in a step is stable
constexpr double fewest_steps = 4;
constexpr int daq_samples_per_sample = 5;
constexpr double settling_s = 3;
constexpr double run_up_share = 0.4;  // of that
constexpr double gear_ratio = 121;
constexpr double rated_torque_Nm = 167;
constexpr double pole_pairs = 2;

// Takes every so many-th sample below half the rate that is left: a Hann-windowed sinc.
class Thinner {
 public:
  explicit Thinner(int every) : every_(every), taps_(half_periods * 2 * every + 1) {
    for (Eigen::Index i = 0; i < taps_.size(); ++i) {
      const double x = static_cast<double>(i - half_periods * every) / every;
      const double sinc =
          x == 0 ? 1 : std::sin(std::numbers::pi * cut * x) / (std::numbers::pi * cut * x);
      taps_[i] = sinc * (1 + std::cos(std::numbers::pi * x / half_periods));
    }
    taps_ /= taps_.sum();
  }
  Eigen::VectorXd operator()(const Eigen::VectorXd& x) const {
    Eigen::VectorXd out((x.size() - taps_.size()) / every_);
    for (Eigen::Index i = 0; i < out.size(); ++i)
      out[i] = taps_.dot(x.segment(i * every_, taps_.size()));
    return out;
  }
  int delay() const { return half_periods * every_; }

 private:
  static constexpr int half_periods = 16;
  static constexpr double cut = 0.88;  // of half the rate that is left
  int every_;
  Eigen::VectorXd taps_;
};

// Coloured noise of unit deviation.
class Colour {
 public:
  Colour(double pole, std::uint64_t seed) : pole_(pole), engine_(seed) {}
  double next() {
    state_ = pole_ * state_ + std::sqrt(1 - pole_ * pole_) * normal_(engine_);
    return state_;
  }

 private:
  double pole_, state_ = 0;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

// Of the train, for each sample of the DAQ.
int steps_for(const sim::PlantSpec& machine) {
  const auto model = sim::make_model(machine);
  const double wanted =
      sim::substeps_wanted(std::get<sim::PlantModel>(model), daq_rate_Hz) / steps_per_wanted;
  return static_cast<int>(std::max(fewest_steps, std::ceil(wanted)));
}

Recording record_of(const sim::PlantSpec& machine, double speed_rpm, double load_pct,
                    const RvMatrix& matrix, sim::Draw& draw) {
  sim::RvUnit unit;
  unit.phases_rad.assign(10, 0);
  unit.friction_factor = 1 + matrix.friction_scatter * draw.uniform(-1.7, 1.7);
  const int steps_per_sample = steps_for(machine);
  sim::RvTrain train(machine, unit, 1 / (daq_rate_Hz * steps_per_sample));
  const Eigen::Vector2d inputs = rv_inputs(speed_rpm, load_pct);
  train.set_brake_torque(inputs[1]);
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) train.step();
    train.wrap();
  };
  const double settle = settling_s * draw.uniform(1, 1.3) * daq_rate_Hz;
  for (int i = 0; i < static_cast<int>(settle); ++i) {
    // As an inverter does: a motor that is switched on at full frequency has little torque.
    train.set_supply(inputs[0] * std::min(1.0, i / (run_up_share * settle)), true);
    run(steps_per_sample);
  }
  const Thinner thin(daq_samples_per_sample);
  const double length_s = matrix.periods * gear_ratio * 60 / speed_rpm;
  const auto late =
      static_cast<Eigen::Index>(std::round(matrix.torque_delay_samples * daq_samples_per_sample));
  const auto count = static_cast<Eigen::Index>(length_s * daq_rate_Hz) + 2 * thin.delay();
  Eigen::VectorXd torque_Nm(count), angle_rad(count);
  for (Eigen::Index i = -std::abs(late); i < count + std::abs(late); ++i) {
    run(steps_per_sample);
    if (i + late >= 0 && i + late < count) torque_Nm[i + late] = train.input_torque_Nm();
    if (i >= 0 && i < count) angle_rad[i] = train.input_angle_rad();
  }
  Recording recording;
  recording.planned_speed_rpm = speed_rpm;
  recording.load_pct = load_pct;
  constexpr double rate_Hz = daq_rate_Hz / daq_samples_per_sample;
  recording.channels = {{{"input_torque", "N·m", "", not_known}, rate_Hz, 0, thin(torque_Nm)},
                        {{"input_angle", "rad", "", not_known}, rate_Hz, 0, thin(angle_rad)}};
  Colour noise(matrix.noise_colour, draw.seed());
  for (double& x : recording.channels[0].samples) {
    x = matrix.torque_gain * x + matrix.torque_noise_Nm * noise.next();
  }
  return recording;
}

}  // namespace

Eigen::Vector2d rv_inputs(double speed_rpm, double load_pct) {
  return {speed_rpm / 60 * pole_pairs, load_pct / 100 * rated_torque_Nm};
}

bench::Campaign rv_campaign(const sim::PlantSpec& machine, std::uint64_t seed,
                            const RvMatrix& matrix) {
  sim::Draw draw(seed);
  bench::Campaign campaign;
  campaign.name = "simulated RV bench";
  for (const double speed_rpm : matrix.speeds_rpm) {
    for (const double load_pct : matrix.loads_pct) {
      for (int repeat = 1; repeat <= matrix.repeats; ++repeat) {
        bench::CampaignRecord record;
        record.condition = fmt::format("{:g} rpm, {:g} %", speed_rpm, load_pct);
        record.name = fmt::format("{}, repeat {}", record.condition, repeat);
        record.speed = fmt::format("{:g} rpm", speed_rpm);
        record.load = fmt::format("{:g} %", load_pct);
        record.programme = record.condition;
        record.recording = record_of(machine, speed_rpm, load_pct, matrix, draw);
        record.recording.repeat = repeat;
        campaign.records.push_back(std::move(record));
      }
    }
  }
  bench::add_planned_inputs(machine, campaign);
  return campaign;
}

sim::PlantSpec within_tolerance(sim::PlantSpec plant, std::uint64_t seed, double share) {
  sim::Draw draw(seed);
  for (const sim::PlacedQuantity& placed : sim::quantities(plant)) {
    const double tolerance = placed.quantity->tolerance_pct / 100;
    if (std::isfinite(tolerance))
      placed.quantity->value *= 1 + share * tolerance * draw.uniform(-1, 1);
  }
  return plant;
}

sim::PlantSpec with_mesh_error(sim::PlantSpec plant) {
  for (sim::TermSpec& term : plant.terms) {
    if (term.type != "planet_mesh") continue;
    term.parameters["profile_error"] = {3e-6, "m", 50};
    term.parameters["profile_phase"] = {0.5, "rad", 0};
  }
  return plant;
}

sim::PlantSpec with_value(sim::PlantSpec plant, const std::string& pointer, double value) {
  for (const sim::PlacedQuantity& placed : sim::quantities(plant)) {
    if (placed.pointer != pointer) continue;
    placed.quantity->value = value;
    return plant;
  }
  throw std::invalid_argument(pointer + ": no quantity of the plant");
}

}  // namespace rvbench::test
