#include "sim/bench_world.hpp"

#include <cmath>

#include "hal/can/in_process_transport.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

constexpr int scans_per_sample = 10;  // of the slow devices; 496 Hz, of a transducer's class
constexpr double transducer_rate_Hz = RvBench::rate_Hz / scans_per_sample;
// rms, of transducer, amplifier and ADC together: 0.01 % of a range of 20 N·m, assumed.
constexpr double transducer_noise_Nm = 0.002;
constexpr double pcb_356a16_V_per_m_s2 = 0.0102;  // maker's sheet: 100 mV/g
// Of the housing against the hall, by natural convection: assumed.
constexpr double heat_K_per_W = 0.15;
constexpr double heat_time_s = 1800;
// Of a 0.75 kW four-pole motor at 230 V; 0.4 of it magnetises the motor: assumed.
constexpr double rated_current_A = 3.4;
constexpr double rated_torque_Nm = 5;
constexpr double no_load_current_share = 0.4;

}  // namespace

std::vector<ChannelInfo> triaxial_channels() {
  std::vector<ChannelInfo> channels;
  for (const char* place : {"1", "2", "3", "4"}) {
    for (const auto& [axis, direction] : {std::pair{"x", "+X"}, {"y", "+Y"}, {"z", "+Z"}}) {
      channels.push_back({.name = std::string("accel_") + place + axis,
                          .unit = "m/s²",
                          .direction = direction,
                          .sensitivity = pcb_356a16_V_per_m_s2});
    }
  }
  return channels;
}

BenchWorld::BenchWorld(RvUnit unit, const InverterParameters& inverter, const PlantSpec& plant,
                       std::uint16_t inverter_port)
    : plant_(std::move(unit), plant),
      inverter_(inverter),
      server_(inverter_, 1, inverter_port),
      torque_filter_(RvBench::rate_Hz, transducer_rate_Hz),
      torque_engine_(plant_.unit().noise_seed + 3),
      channels_(triaxial_channels()),
      scan_(RvBench::sensors) {
  hal::InProcessBus bus = hal::make_in_process_bus([this] { return now_s(); });
  bench_end_ = std::move(bus.bench);
  node_end_ = std::move(bus.nodes);
  transducer_ = std::make_unique<TransducerNode>(*node_end_, transducer_rate_Hz);
  brake_ = std::make_unique<BrakeNode>(*node_end_, BrakeNode::Parameters{});
}

std::unique_ptr<hal::CanTransport> BenchWorld::make_can_transport() {
  return std::move(bench_end_);
}

void BenchWorld::advance_to(double time_s) {
  while (static_cast<double>(scans_ + 1) / RvBench::rate_Hz <= time_s) step();
  now_s_ = std::max<double>(now_s_, time_s);
}

void BenchWorld::at(double time_s, std::function<void()> what) {
  if (time_s <= now_s_) {
    what();
  } else {
    events_.emplace(time_s, std::move(what));
  }
}

void BenchWorld::step() {
  constexpr double dt_s = 1 / RvBench::rate_Hz;
  ++scans_;
  now_s_ = static_cast<double>(scans_) / RvBench::rate_Hz;
  while (!events_.empty() && events_.begin()->first <= now_s_) {
    events_.extract(events_.begin()).mapped()();
  }
  inverter_.advance(dt_s);
  plant_.set_supply(inverter_.output_frequency_Hz(), inverter_.output_enabled());
  plant_.set_brake_torque(brake_->setpoint_Nm());
  plant_.step(scan_);
  if (!daq_stopped_) {
    waiting_.insert(waiting_.end(), scan_.data(), scan_.data() + scan_.size());
  }
  const double torque_Nm = torque_filter_.step(plant().input_torque_Nm());
  if (scans_ % scans_per_sample != 0) return;
  transducer_->advance_to(now_s_, torque_Nm + torque_noise_Nm(), plant().input_angle_rad());
  brake_->advance_to(now_s_, plant().brake_torque_Nm());
  const double share = plant().motor_torque_Nm() / rated_torque_Nm;
  inverter_.set_measured(units::rpm_from_rad_s(plant().motor_speed_rad_s()),
                         rated_current_A * std::hypot(no_load_current_share, share));
  heat(scans_per_sample * dt_s);
}

double BenchWorld::torque_noise_Nm() {
  return transducer_noise_Nm * plant_.unit().noise_level_factor * torque_noise_(torque_engine_);
}

// First-order warming of the housing by what the reducer does not pass on.
void BenchWorld::heat(double dt_s) {
  const double loss_W = std::abs(plant().input_torque_Nm() * plant().motor_speed_rad_s() -
                                 plant().brake_torque_Nm() * plant().output_speed_rad_s());
  const double target_degC = hall_degC + heat_K_per_W * loss_W;
  housing_temp_degC_ += (target_degC - housing_temp_degC_) * dt_s / heat_time_s;
}

hal::AccelerationBlock BenchWorld::take_accelerations() {
  hal::AccelerationBlock block;
  block.time_uncertainty_s = 0;
  const auto channels = static_cast<Eigen::Index>(channels_.size());
  const auto count = static_cast<Eigen::Index>(waiting_.size()) / channels;
  block.t0_s = static_cast<double>(taken_ + 1) / RvBench::rate_Hz;
  block.scans = Eigen::Map<const hal::AccelerationBlock::Scans>(waiting_.data(), count, channels);
  waiting_.clear();
  taken_ += count;
  return block;
}

hal::SafetyStatus BenchWorld::safety_status() const {
  return {.estop_pressed = estop_pressed_,
          .guard_open = guard_open_,
          .housing_temp_degC = housing_temp_is_known_ ? housing_temp_degC_ : not_known};
}

}  // namespace rvbench::sim
