#include "tests/faults/fault_bench.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::test {
namespace {

constexpr double slip = 0.01;
constexpr double rotor_time_s = 0.03;   // how fast the shaft follows the field
constexpr double inertia_kg_m2 = 2e-3;  // of motor, coupling and reducer at the input
constexpr double friction_Nm = 0.1;     // at the input
constexpr double efficiency = 0.8;
constexpr double drift_m_s3 = 150;       // of a charge amplifier that integrates its leak,
constexpr double most_drift_m_s2 = 250;  // until its limiter holds it
constexpr double coupling_s = 0.3;       // time constant of AC coupling at 0.5 Hz

}  // namespace

const char* to_string(BenchState state) {
  constexpr std::array names{"connecting", "arming",         "warming_up",      "settling",
                             "recording",  "settling_again", "recording_again", "stopping"};
  return names[static_cast<std::size_t>(state)];
}

FaultBench::FaultBench(std::uint64_t seed, const sim::InverterParameters& parameters)
    : inverter(parameters),
      server(inverter),
      bus(hal::make_in_process_bus([this] { return time_s_; })),
      wire(
          *bus.nodes, [this] { return time_s_; }, truth.torques),
      transducer(wire, 500),
      brake(wire, {}),
      random_(seed),
      channels_{
          {"accel_1x", "m/s²", "+X"}, {"accel_1y", "m/s²", "+Y"}, {"accel_1z", "m/s²", "+Z"}} {
  enter(BenchState::connecting);
}

std::unique_ptr<hal::CanTransport> FaultBench::make_can_transport() {
  return std::make_unique<FragileBus>(std::move(bus.bench), disturbance.bus_off);
}

void FaultBench::advance_to(double time_s) {
  time_s += std::exchange(disturbance.stall_s, 0);
  while (double(steps_ + 1) / rate_Hz <= time_s) step();
  time_s_ = std::max(time_s_, time_s);
}

void FaultBench::when(BenchState state, double after_s, std::function<void()> what) {
  triggers_.push_back({state, after_s, std::move(what)});
  fire_triggers();
}

double FaultBench::speed_rpm() const { return units::rpm_from_rad_s(speed_rad_s_); }

bool FaultBench::is_driven() const {
  const sim::InverterState state = inverter.state();
  return state.output_enabled && state.run != sim::RunCommand::stop && state.setpoint_Hz > 0;
}

void FaultBench::step() {
  constexpr double dt_s = 1 / rate_Hz;
  ++steps_;
  time_s_ = double(steps_) / rate_Hz;
  inverter.advance(dt_s);
  turn(dt_s);
  if (!disturbance.speed_stuck) inverter.set_measured(speed_rpm(), 1.5);
  const double shown_Nm = disturbance.over_torque ? 100 : input_torque_Nm_;
  if (!disturbance.angle_stuck) shown_angle_rad_ = angle_rad_;
  if (disturbance.torque_lossy && steps_ % 25 == 0) transducer.lose_frames(1);
  transducer.advance_to(time_s_, disturbance.torque_inverted ? -shown_Nm : shown_Nm,
                        shown_angle_rad_);
  const bool was_braked = brake_Nm() > 0;
  brake.advance_to(time_s_, brake_Nm());
  if (wire.take_release() && was_braked) {
    released_s_ = time_s_;
    released_rpm_ = std::abs(speed_rpm());
  }
  sample();
  if (is_driven()) driven_until_s_ = time_s_;
  if (std::abs(speed_rpm()) > moves_rpm) moved_until_s_ = time_s_;
  if (brake_Nm() > 0) braked_until_s_ = time_s_;
  follow_states();
  fire_triggers();
}

void FaultBench::turn(double dt_s) {
  const double direction = speed_rad_s_ == 0 ? 0 : std::copysign(1.0, speed_rad_s_);
  const double load_Nm = direction * (friction_Nm + brake_Nm() / gear_ratio / efficiency);
  if (inverter.output_enabled()) {
    const double field_rad_s =
        2 * M_PI * inverter.output_frequency_Hz() * (1 - slip) / inverter.parameters().pole_pairs;
    const double before_rad_s = speed_rad_s_;
    speed_rad_s_ += (field_rad_s - speed_rad_s_) * dt_s / rotor_time_s;
    input_torque_Nm_ = load_Nm + inertia_kg_m2 * (speed_rad_s_ - before_rad_s) / dt_s;
  } else {
    const double slowed_rad_s = std::abs(load_Nm) * dt_s / inertia_kg_m2;
    speed_rad_s_ -= direction * std::min(std::abs(speed_rad_s_), slowed_rad_s);
    input_torque_Nm_ = 0;
  }
  angle_rad_ += speed_rad_s_ * dt_s;
}

void FaultBench::sample() {
  if (disturbance.daq_stopped) return;
  if (disturbance.scans_to_swallow > 0) {
    --disturbance.scans_to_swallow;
    return;
  }
  const bool is_lost = disturbance.scans_to_lose > 0 && disturbance.scans_to_lose-- > 0;
  const bool again = disturbance.daq_fast && steps_ % 20 == 0;
  for (int times = again ? 2 : 1; times > 0; --times) {
    const float shaft = float(2e-4 * speed_rad_s_ * speed_rad_s_ * std::cos(angle_rad_));
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      float value = shaft + noise_(random_);
      if (i == 1) value = spoilt(value);
      if (is_lost || (disturbance.scans_lost && steps_ % 10 == 0)) value = std::nanf("");
      waiting_.push_back(value);
    }
  }
}

float FaultBench::spoilt(float value) {
  constexpr auto most = float(range_m_s2);
  if (disturbance.mains_hum) {
    const double turn = units::two_pi * 50 * time_s_;
    value += float(20 * std::cos(turn) + 8 * std::cos(3 * turn) + 4 * std::cos(5 * turn));
  }
  if (disturbance.drifts) {
    drifted_m_s2_ = std::min(drifted_m_s2_ + drift_m_s3 / rate_Hz, most_drift_m_s2);
    value += float(drifted_m_s2_);
  }
  if (disturbance.iepe_off) {
    disturbance.bias_jump_m_s2 *= std::exp(-1 / (rate_Hz * coupling_s));
    value = float(disturbance.bias_jump_m_s2) + 2e-3F * noise_(random_);
    value = std::clamp(value, -most, most);
  }
  if (disturbance.channel_open) value = most;
  if (disturbance.channel_flat) value = 0;
  if (disturbance.channel_clipped) value = std::clamp(1000 * value, -most, most);
  if (std::exchange(disturbance.spike, false)) value = 0.95F * most;
  return value;
}

hal::AccelerationBlock FaultBench::take_accelerations() {
  hal::AccelerationBlock block;
  const auto channels = Eigen::Index(channels_.size());
  const auto scans = Eigen::Index(waiting_.size()) / channels;
  block.t0_s = double(taken_ + 1) / rate_Hz;
  block.scans = Eigen::Map<const hal::AccelerationBlock::Scans>(waiting_.data(), scans, channels);
  block.lost = int(block.scans.col(0).array().isNaN().count());
  truth.scans.insert(truth.scans.end(), waiting_.begin(), waiting_.end());
  waiting_.clear();
  taken_ += scans;
  return block;
}

void FaultBench::enter(BenchState state) { entered_s_.try_emplace(state, time_s_); }

double FaultBench::entered_s(BenchState state) const {
  const auto entered = entered_s_.find(state);
  return entered == entered_s_.end() ? not_known : entered->second;
}

void FaultBench::follow_states() {
  if (safety_was_read_) enter(BenchState::arming);  // all is connected: the supervisor looks
  const sim::InverterState drive = inverter.state();
  const double asked_Hz = drive.run == sim::RunCommand::stop ? 0 : drive.setpoint_Hz;
  if (asked_Hz > 0 && asked_Hz != setpoint_Hz_) {
    constexpr std::array states{BenchState::warming_up, BenchState::settling,
                                BenchState::settling_again};
    enter(states.at(std::size_t(std::min(speeds_asked_++, 2))));
  }
  if (asked_Hz == 0 && setpoint_Hz_ > 0) enter(BenchState::stopping);
  setpoint_Hz_ = asked_Hz;
  if (asked_Hz == 0) return;
  if (time_s_ > entered_s(BenchState::settling) + record_after_s) enter(BenchState::recording);
  if (time_s_ > entered_s(BenchState::settling_again) + record_after_s) {
    enter(BenchState::recording_again);
  }
}

void FaultBench::fire_triggers() {
  std::vector<Trigger> due;
  std::erase_if(triggers_, [&](const Trigger& trigger) {
    const bool is_due = time_s_ >= entered_s(trigger.state) + trigger.after_s;  // not if NaN
    if (is_due) due.push_back(trigger);
    return is_due;
  });
  for (const Trigger& trigger : due) trigger.what();
}

}  // namespace rvbench::test
