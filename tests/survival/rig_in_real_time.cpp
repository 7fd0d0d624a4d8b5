#include "tests/survival/rig_in_real_time.hpp"

#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

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

class PacedSafetyInputs final : public hal::SafetyInputs {
 public:
  PacedSafetyInputs(std::unique_ptr<hal::SafetyInputs> inputs, PacedClock& clock)
      : inputs_(std::move(inputs)), clock_(clock) {}
  Status connect() override {
    return clock_.at_this_moment([this] { return inputs_->connect(); });
  }
  Result<hal::SafetyStatus> read() override {
    return clock_.at_this_moment([this] { return inputs_->read(); });
  }

 private:
  std::unique_ptr<hal::SafetyInputs> inputs_;
  PacedClock& clock_;
};

class PacedAccelerometers final : public hal::Accelerometers {
 public:
  PacedAccelerometers(std::unique_ptr<hal::Accelerometers> sensors, PacedClock& clock)
      : sensors_(std::move(sensors)), clock_(clock) {}
  const std::vector<ChannelInfo>& channels() const override { return sensors_->channels(); }
  double range_m_s2() const override { return sensors_->range_m_s2(); }
  double rate_Hz() const override { return sensors_->rate_Hz(); }
  Status connect() override {
    return clock_.at_this_moment([this] { return sensors_->connect(); });
  }
  Status start() override {
    return clock_.at_this_moment([this] { return sensors_->start(); });
  }
  Result<hal::AccelerationBlock> read() override {
    return clock_.at_this_moment([this] { return sensors_->read(); });
  }
  void stop() noexcept override {
    clock_.at_this_moment([this] { sensors_->stop(); });
  }

 private:
  std::unique_ptr<hal::Accelerometers> sensors_;
  PacedClock& clock_;
};

class PacedTorqueSensor final : public hal::TorqueSensor {
 public:
  PacedTorqueSensor(std::unique_ptr<hal::TorqueSensor> sensor, PacedClock& clock)
      : sensor_(std::move(sensor)), clock_(clock) {}
  double rate_Hz() const override { return sensor_->rate_Hz(); }
  Status connect() override {
    return clock_.at_this_moment([this] { return sensor_->connect(); });
  }
  Result<hal::TorqueBlock> read() override {
    return clock_.at_this_moment([this] { return sensor_->read(); });
  }

 private:
  std::unique_ptr<hal::TorqueSensor> sensor_;
  PacedClock& clock_;
};

class PacedBrake final : public hal::Brake {
 public:
  PacedBrake(std::unique_ptr<hal::Brake> brake, PacedClock& clock)
      : brake_(std::move(brake)), clock_(clock) {}
  hal::BrakeLimits limits() const override { return brake_->limits(); }
  Status connect() override {
    return clock_.at_this_moment([this] { return brake_->connect(); });
  }
  Status set_torque(double torque_Nm) override {
    return clock_.at_this_moment([&] { return brake_->set_torque(torque_Nm); });
  }
  Result<hal::BrakeStatus> read() override {
    return clock_.at_this_moment([this] { return brake_->read(); });
  }
  Status release() noexcept override {
    return clock_.at_this_moment([this] { return brake_->release(); });
  }

 private:
  std::unique_ptr<hal::Brake> brake_;
  PacedClock& clock_;
};

class PacedDrive final : public hal::Drive {
 public:
  PacedDrive(std::unique_ptr<hal::Drive> drive, PacedClock& clock)
      : drive_(std::move(drive)), clock_(clock) {}
  hal::DriveLimits limits() const override { return drive_->limits(); }
  Status connect() override {
    return clock_.at_this_moment([this] { return drive_->connect(); });
  }
  Result<hal::DriveWatchdog> read_watchdog() override {
    return clock_.at_this_moment([this] { return drive_->read_watchdog(); });
  }
  Status set_speed(double speed_rpm) override {
    return clock_.at_this_moment([&] { return drive_->set_speed(speed_rpm); });
  }
  Result<hal::DriveStatus> read() override {
    return clock_.at_this_moment([this] { return drive_->read(); });
  }
  void stop() noexcept override {
    clock_.at_this_moment([this] { drive_->stop(); });
  }
  int retries() const override { return drive_->retries(); }

 private:
  std::unique_ptr<hal::Drive> drive_;
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
