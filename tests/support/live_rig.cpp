#include "tests/support/live_rig.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "hal/steady_clock.hpp"
#include "hal/types/units.hpp"

namespace rvbench::test {
namespace {

constexpr double torque_rate_Hz = 1000;
constexpr double acceleration_rate_Hz = 4960;

// The shaft, asked for by drive and transducer.
class Shaft {
 public:
  Shaft(LiveBench& bench, double ramp_rpm_s) : bench_(bench), ramp_rpm_s_(ramp_rpm_s) {}

  double speed_rpm(double time_s) {
    const std::lock_guard lock(mutex_);
    turn_to(time_s);
    return speed_rpm_;
  }
  double angle_rad(double time_s) {
    const std::lock_guard lock(mutex_);
    turn_to(time_s);
    return angle_rad_ + units::rad_s_from_rpm(speed_rpm_) * (time_s - time_s_);
  }

 private:
  void turn_to(double time_s) {
    constexpr double step_s = 0.0005;
    for (; time_s_ + step_s <= time_s; time_s_ += step_s) {
      const double most_rpm = ramp_rpm_s_ * step_s;
      speed_rpm_ += std::clamp(bench_.setpoint_rpm - speed_rpm_, -most_rpm, most_rpm);
      angle_rad_ += units::rad_s_from_rpm(speed_rpm_) * step_s;
    }
  }

  LiveBench& bench_;
  const double ramp_rpm_s_;
  std::mutex mutex_;
  double time_s_ = 0, speed_rpm_ = 0, angle_rad_ = 0;
};

class LiveDrive final : public hal::Drive {
 public:
  LiveDrive(LiveBench& bench, std::shared_ptr<Shaft> shaft)
      : bench_(bench), shaft_(std::move(shaft)) {}
  hal::DriveLimits limits() const override { return {.max_speed_rpm = 3000}; }
  Status connect() override { return Done{}; }
  Result<hal::DriveWatchdog> read_watchdog() override { return hal::DriveWatchdog{0.5, true}; }
  Status set_speed(double speed_rpm) override {
    if (bench_.drive_hangs) return hang();
    bench_.setpoint_rpm = speed_rpm;
    return Done{};
  }
  Result<hal::DriveStatus> read() override {
    if (bench_.drive_hangs) return hang();
    hal::DriveStatus status;
    status.speed_rpm = shaft_->speed_rpm(bench_.clock.now_s());
    status.running = bench_.setpoint_rpm != 0;
    return status;
  }
  void stop() noexcept override {
    bench_.setpoint_rpm = 0;
    if (bench_.stop_is_slow) bench_.clock.wait_until(bench_.clock.now_s() + 0.05);
    bench_.stopped_s = bench_.clock.now_s();
    ++bench_.stops;
  }
  int retries() const override { return 0; }

 private:
  IoError hang() {
    bench_.clock.wait_until(bench_.clock.now_s() + 0.05);
    return {IoErrc::timeout, "live drive"};
  }

  LiveBench& bench_;
  std::shared_ptr<Shaft> shaft_;
};

class LiveBrake final : public hal::Brake {
 public:
  explicit LiveBrake(LiveBench& bench) : bench_(bench) {}
  hal::BrakeLimits limits() const override { return {.max_torque_Nm = 400}; }
  Status connect() override { return Done{}; }
  Status set_torque(double torque_Nm) override {
    bench_.brake_Nm = torque_Nm;
    ++bench_.brake_commands;
    return Done{};
  }
  Result<hal::BrakeStatus> read() override { return hal::BrakeStatus{bench_.brake_Nm, false}; }
  Status release() noexcept override {
    bench_.brake_Nm = 0;
    return Done{};
  }

 private:
  LiveBench& bench_;
};

class LiveSafety final : public hal::SafetyInputs {
 public:
  explicit LiveSafety(LiveBench& bench) : bench_(bench) {}
  Status connect() override { return Done{}; }
  Result<hal::SafetyStatus> read() override { return hal::SafetyStatus{bench_.estop, false, 25}; }

 private:
  LiveBench& bench_;
};

// Samples that have come since they were asked for last.
class SampleCount {
 public:
  explicit SampleCount(double rate_Hz) : rate_Hz_(rate_Hz) {}
  void start(double time_s) { made_ = long(std::ceil(time_s * rate_Hz_)); }
  double t0_s() const { return double(made_) / rate_Hz_; }
  long take(double time_s) {
    const long due = long(std::floor(time_s * rate_Hz_));
    const long fresh = std::max(0L, due - made_);
    made_ += fresh;
    return fresh;
  }

 private:
  double rate_Hz_;
  long made_ = 0;
};

class LiveTorque final : public hal::TorqueSensor {
 public:
  LiveTorque(LiveBench& bench, std::shared_ptr<Shaft> shaft)
      : bench_(bench), shaft_(std::move(shaft)) {}
  double rate_Hz() const override { return torque_rate_Hz; }
  Status connect() override {
    count_.start(bench_.clock.now_s());
    return Done{};
  }
  Result<hal::TorqueBlock> read() override {
    hal::TorqueBlock block;
    block.t0_s = count_.t0_s();
    const long fresh = count_.take(bench_.clock.now_s());
    for (long i = 0; i < fresh; ++i) {
      block.samples.push_back(
          {bench_.torque_Nm, shaft_->angle_rad(block.t0_s + double(i) / torque_rate_Hz)});
    }
    return block;
  }

 private:
  LiveBench& bench_;
  std::shared_ptr<Shaft> shaft_;
  SampleCount count_{torque_rate_Hz};
};

class LiveAccelerometers final : public hal::Accelerometers {
 public:
  explicit LiveAccelerometers(LiveBench& bench) : bench_(bench) {}
  const std::vector<ChannelInfo>& channels() const override { return channels_; }
  double range_m_s2() const override { return 500; }
  double rate_Hz() const override { return acceleration_rate_Hz; }
  Status connect() override { return Done{}; }
  Status start() override {
    count_.start(bench_.clock.now_s());
    return Done{};
  }
  Result<hal::AccelerationBlock> read() override {
    hal::AccelerationBlock block;
    block.t0_s = count_.t0_s();
    const long fresh = count_.take(bench_.clock.now_s());
    block.scans.resize(fresh, 1);
    for (long i = 0; i < fresh; ++i) block.scans(i, 0) = float(i % 7);
    return block;
  }
  void stop() noexcept override {}

 private:
  LiveBench& bench_;
  SampleCount count_{acceleration_rate_Hz};
  std::vector<ChannelInfo> channels_{{"accel_1x", "m/s²", "+X"}};
};

}  // namespace

LiveBench& live_bench(hal::Rig& rig) { return static_cast<LiveBench&>(*rig.backstage); }

hal::Rig make_live_rig(double ramp_rpm_s) {
  hal::Rig rig;
  rig.name = "live";
  rig.clock = std::make_unique<hal::SteadyClock>();
  auto bench = std::make_unique<LiveBench>(*rig.clock);
  const auto shaft = std::make_shared<Shaft>(*bench, ramp_rpm_s);
  rig.safety = std::make_unique<LiveSafety>(*bench);
  rig.accelerometers = std::make_unique<LiveAccelerometers>(*bench);
  rig.torque_sensor = std::make_unique<LiveTorque>(*bench, shaft);
  rig.brake = std::make_unique<LiveBrake>(*bench);
  rig.drive = std::make_unique<LiveDrive>(*bench, shaft);
  rig.backstage = std::move(bench);
  return rig;
}

}  // namespace rvbench::test
