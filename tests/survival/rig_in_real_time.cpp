#include "tests/survival/rig_in_real_time.hpp"

#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

#include "tests/support/passing_devices.hpp"

namespace rvbench::test {
namespace {

// The rig's own clock stands still but while a device is called: one call at a time.
class PacedClock final : public hal::Clock {
 public:
  PacedClock(std::unique_ptr<hal::Clock> clock, double pace)
      : clock_(std::move(clock)), pace_(pace) {}

  double now_s() const override {
    return pace_ * std::chrono::duration<double>(Real::now() - began_).count();
  }
  void wait_until(double time_s) override {
    std::this_thread::sleep_until(began_ + std::chrono::duration_cast<Real::duration>(
                                               std::chrono::duration<double>(time_s / pace_)));
  }
  bool is_virtual() const override { return false; }

  template <typename Call>
  auto at_this_moment(Call&& call) {
    const std::lock_guard lock(mutex_);
    clock_->wait_until(now_s());
    return call();
  }

 private:
  using Real = std::chrono::steady_clock;
  std::unique_ptr<hal::Clock> clock_;
  double pace_;
  std::mutex mutex_;
  Real::time_point began_ = Real::now();
};

class PacedSafetyInputs final : public PassingSafetyInputs {
 public:
  PacedSafetyInputs(std::unique_ptr<hal::SafetyInputs> inputs, PacedClock& clock)
      : PassingSafetyInputs(std::move(inputs)), clock_(clock) {}
  Status connect() override {
    return clock_.at_this_moment([this] { return behind_->connect(); });
  }
  Result<hal::SafetyStatus> read() override {
    return clock_.at_this_moment([this] { return behind_->read(); });
  }

 private:
  PacedClock& clock_;
};

class PacedAccelerometers final : public PassingAccelerometers {
 public:
  PacedAccelerometers(std::unique_ptr<hal::Accelerometers> sensors, PacedClock& clock)
      : PassingAccelerometers(std::move(sensors)), clock_(clock) {}
  Status connect() override {
    return clock_.at_this_moment([this] { return behind_->connect(); });
  }
  Status start() override {
    return clock_.at_this_moment([this] { return behind_->start(); });
  }
  Result<hal::AccelerationBlock> read() override {
    return clock_.at_this_moment([this] { return behind_->read(); });
  }
  void stop() noexcept override {
    clock_.at_this_moment([this] { behind_->stop(); });
  }

 private:
  PacedClock& clock_;
};

class PacedTorqueSensor final : public PassingTorqueSensor {
 public:
  PacedTorqueSensor(std::unique_ptr<hal::TorqueSensor> sensor, PacedClock& clock)
      : PassingTorqueSensor(std::move(sensor)), clock_(clock) {}
  Status connect() override {
    return clock_.at_this_moment([this] { return behind_->connect(); });
  }
  Result<hal::TorqueBlock> read() override {
    return clock_.at_this_moment([this] { return behind_->read(); });
  }

 private:
  PacedClock& clock_;
};

class PacedBrake final : public PassingBrake {
 public:
  PacedBrake(std::unique_ptr<hal::Brake> brake, PacedClock& clock)
      : PassingBrake(std::move(brake)), clock_(clock) {}
  Status connect() override {
    return clock_.at_this_moment([this] { return behind_->connect(); });
  }
  Status set_torque(double torque_Nm) override {
    return clock_.at_this_moment([&] { return behind_->set_torque(torque_Nm); });
  }
  Result<hal::BrakeStatus> read() override {
    return clock_.at_this_moment([this] { return behind_->read(); });
  }
  Status release() noexcept override {
    return clock_.at_this_moment([this] { return behind_->release(); });
  }

 private:
  PacedClock& clock_;
};

class PacedDrive final : public PassingDrive {
 public:
  PacedDrive(std::unique_ptr<hal::Drive> drive, PacedClock& clock)
      : PassingDrive(std::move(drive)), clock_(clock) {}
  Status connect() override {
    return clock_.at_this_moment([this] { return behind_->connect(); });
  }
  Result<hal::DriveWatchdog> read_watchdog() override {
    return clock_.at_this_moment([this] { return behind_->read_watchdog(); });
  }
  Status set_speed(double speed_rpm) override {
    return clock_.at_this_moment([&] { return behind_->set_speed(speed_rpm); });
  }
  Result<hal::DriveStatus> read() override {
    return clock_.at_this_moment([this] { return behind_->read(); });
  }
  void stop() noexcept override {
    clock_.at_this_moment([this] { behind_->stop(); });
  }

 private:
  PacedClock& clock_;
};

}  // namespace

hal::Rig in_real_time(hal::Rig rig, double pace) {
  auto paced = std::make_unique<PacedClock>(std::move(rig.clock), pace);
  PacedClock& clock = *paced;
  rig.clock = std::move(paced);
  rig.safety = std::make_unique<PacedSafetyInputs>(std::move(rig.safety), clock);
  rig.accelerometers = std::make_unique<PacedAccelerometers>(std::move(rig.accelerometers), clock);
  rig.torque_sensor = std::make_unique<PacedTorqueSensor>(std::move(rig.torque_sensor), clock);
  rig.brake = std::make_unique<PacedBrake>(std::move(rig.brake), clock);
  rig.drive = std::make_unique<PacedDrive>(std::move(rig.drive), clock);
  return rig;
}

}  // namespace rvbench::test
