#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "hal/accelerometers.hpp"
#include "hal/brake.hpp"
#include "hal/drive.hpp"
#include "hal/safety_inputs.hpp"
#include "hal/torque_sensor.hpp"

/// Devices that pass every call on to the one behind them. A test overrides the calls that it is
/// about, or show(), which may change what was read before it is told.
namespace rvbench::test {

/// Applies `show` to a reading; returns a failed one as it is.
template <typename Read, typename Show>
Result<Read> shown(Result<Read> read, const Show& show) {
  if (!read) return read;
  Read changed = std::move(read).value();
  show(changed);
  return changed;
}

class PassingDrive : public hal::Drive {
 public:
  explicit PassingDrive(std::unique_ptr<hal::Drive> behind) : behind_(std::move(behind)) {}
  hal::DriveLimits limits() const override { return behind_->limits(); }
  Status connect() override { return behind_->connect(); }
  Result<hal::DriveWatchdog> read_watchdog() override { return behind_->read_watchdog(); }
  Status set_speed(double speed_rpm) override { return behind_->set_speed(speed_rpm); }
  Result<hal::DriveStatus> read() override {
    return shown(behind_->read(), [this](auto& read) { show(read); });
  }
  void stop() noexcept override { behind_->stop(); }
  int retries() const override { return behind_->retries(); }

 protected:
  virtual void show(hal::DriveStatus&) {}

  std::unique_ptr<hal::Drive> behind_;
};

class PassingBrake : public hal::Brake {
 public:
  explicit PassingBrake(std::unique_ptr<hal::Brake> behind) : behind_(std::move(behind)) {}
  hal::BrakeLimits limits() const override { return behind_->limits(); }
  Status connect() override { return behind_->connect(); }
  Status set_torque(double torque_Nm) override { return behind_->set_torque(torque_Nm); }
  Result<hal::BrakeStatus> read() override {
    return shown(behind_->read(), [this](auto& read) { show(read); });
  }
  Status release() noexcept override { return behind_->release(); }

 protected:
  virtual void show(hal::BrakeStatus&) {}

  std::unique_ptr<hal::Brake> behind_;
};

class PassingTorqueSensor : public hal::TorqueSensor {
 public:
  explicit PassingTorqueSensor(std::unique_ptr<hal::TorqueSensor> behind)
      : behind_(std::move(behind)) {}
  double rate_Hz() const override { return behind_->rate_Hz(); }
  Status connect() override { return behind_->connect(); }
  Result<hal::TorqueBlock> read() override {
    return shown(behind_->read(), [this](auto& read) { show(read); });
  }

 protected:
  virtual void show(hal::TorqueBlock&) {}

  std::unique_ptr<hal::TorqueSensor> behind_;
};

class PassingAccelerometers : public hal::Accelerometers {
 public:
  explicit PassingAccelerometers(std::unique_ptr<hal::Accelerometers> behind)
      : behind_(std::move(behind)) {}
  const std::vector<ChannelInfo>& channels() const override { return behind_->channels(); }
  double range_m_s2() const override { return behind_->range_m_s2(); }
  double rate_Hz() const override { return behind_->rate_Hz(); }
  double hole_told_after_s() const override { return behind_->hole_told_after_s(); }
  Status connect() override { return behind_->connect(); }
  Status start() override { return behind_->start(); }
  Result<hal::AccelerationBlock> read() override {
    return shown(behind_->read(), [this](auto& read) { show(read); });
  }
  void stop() noexcept override { behind_->stop(); }

 protected:
  virtual void show(hal::AccelerationBlock&) {}

  std::unique_ptr<hal::Accelerometers> behind_;
};

class PassingSafetyInputs : public hal::SafetyInputs {
 public:
  explicit PassingSafetyInputs(std::unique_ptr<hal::SafetyInputs> behind)
      : behind_(std::move(behind)) {}
  Status connect() override { return behind_->connect(); }
  Result<hal::SafetyStatus> read() override {
    return shown(behind_->read(), [this](auto& read) { show(read); });
  }

 protected:
  virtual void show(hal::SafetyStatus&) {}

  std::unique_ptr<hal::SafetyInputs> behind_;
};

}  // namespace rvbench::test
