#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "hal/can/in_process_transport.hpp"
#include "hal/plant_port.hpp"
#include "hal/types/units.hpp"
#include "sim/brake_node.hpp"
#include "sim/inverter_model.hpp"
#include "sim/inverter_server.hpp"
#include "sim/transducer_node.hpp"

namespace rvbench::test {

/// A bench without physics behind real protocols: the shaft turns as the inverter's field does, its
/// torque is 0.5 N·m, the brake measures its setpoint, the accelerometers tell the time in
/// milliseconds.
class BarePlant final : public hal::PlantPort {
 public:
  static constexpr double step_s = 0.001;

  explicit BarePlant(const sim::InverterParameters& parameters = {})
      : inverter(parameters),
        server(inverter),
        bus(hal::make_in_process_bus([this] { return time_s_; })),
        transducer(*bus.nodes, 500),
        brake(*bus.nodes, {}) {}

  double now_s() const override { return time_s_; }

  void advance_to(double time_s) override {
    while (time_s_ < time_s) step(std::min(step_s, time_s - time_s_));
  }

  std::uint16_t inverter_tcp_port() const override { return server.port(); }
  std::unique_ptr<hal::CanTransport> make_can_transport() override { return std::move(bus.bench); }
  const std::vector<ChannelInfo>& acceleration_channels() const override { return channels_; }
  double acceleration_rate_Hz() const override { return 1000; }
  double acceleration_range_m_s2() const override { return 490; }
  hal::SafetyStatus safety_status() const override { return safety; }

  hal::AccelerationBlock take_accelerations() override {
    hal::AccelerationBlock block;
    block.t0_s = static_cast<double>(scans_ - waiting_) * step_s;
    block.scans.resize(waiting_, static_cast<Eigen::Index>(channels_.size()));
    for (Eigen::Index i = 0; i < waiting_; ++i) {
      block.scans.row(i).setConstant(static_cast<float>(scans_ - waiting_ + i));
    }
    waiting_ = 0;
    return block;
  }

  double speed_rpm() const { return speed_rpm_; }

  sim::InverterModel inverter;
  sim::InverterServer server;
  hal::InProcessBus bus;
  sim::TransducerNode transducer;
  sim::BrakeNode brake;
  hal::SafetyStatus safety{.estop_pressed = false, .guard_open = false, .housing_temp_degC = 25};
  bool daq_alive = true;

 private:
  void step(double dt_s) {
    inverter.advance(dt_s);
    const int pole_pairs = inverter.parameters().pole_pairs;
    speed_rpm_ = units::rpm_from_Hz(inverter.output_frequency_Hz()) / pole_pairs;
    inverter.set_measured(speed_rpm_, 1.5);
    time_s_ += dt_s;
    angle_rad_ += units::rad_s_from_rpm(speed_rpm_) * dt_s;
    transducer.advance_to(time_s_, 0.5, angle_rad_);
    brake.advance_to(time_s_, brake.setpoint_Nm());
    for (; static_cast<double>(scans_) * step_s <= time_s_; ++scans_) waiting_ += daq_alive ? 1 : 0;
  }

  double time_s_ = 0;
  double speed_rpm_ = 0;
  double angle_rad_ = 0;
  Eigen::Index scans_ = 0;
  Eigen::Index waiting_ = 0;
  std::vector<ChannelInfo> channels_{{"accel_1x", "m/s²", "+X"}, {"accel_1y", "m/s²", "+Y"}};
};

}  // namespace rvbench::test
