#pragma once

#include "hal/can/in_process_transport.hpp"
#include "hal/clock.hpp"
#include "hal/types/units.hpp"
#include "sim/brake_node.hpp"
#include "sim/transducer_node.hpp"

namespace rvbench::test {

/// A virtual clock that moves one transducer, on a shaft of constant speed, and one brake, on one
/// bus. Take `bus.bench` for the devices under test.
class CanBench final : public hal::Clock {
 public:
  static constexpr double torque_Nm = 1.234567;
  static constexpr double speed_rpm = 3000;
  static constexpr double rate_Hz = 500;

  double now_s() const override { return time_s_; }
  bool is_virtual() const override { return true; }

  void wait_until(double time_s) override {
    while (time_s_ < time_s - 1e-9) {
      time_s_ = static_cast<double>(++steps_) * 0.001;
      transducer.advance_to(time_s_, torque_Nm, angle_rad(time_s_));
      brake.advance_to(time_s_, brake.setpoint_Nm());
    }
  }

  static double angle_rad(double time_s) { return units::rad_s_from_rpm(speed_rpm) * time_s; }

  hal::InProcessBus bus = hal::make_in_process_bus([this] { return time_s_; });
  sim::TransducerNode transducer{*bus.nodes, rate_Hz};
  sim::BrakeNode brake{*bus.nodes, {}};

 private:
  long steps_ = 0;
  double time_s_ = 0;
};

}  // namespace rvbench::test
