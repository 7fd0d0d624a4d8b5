#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "hal/accelerometers.hpp"
#include "hal/brake.hpp"
#include "hal/drive.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::test {

/// Accelerometers whose scans are spoilt on their way.
class SpoiltAccelerometers final : public hal::Accelerometers {
 public:
  using Spoil = std::function<void(hal::AccelerationBlock::Scans& scans)>;

  SpoiltAccelerometers(std::unique_ptr<hal::Accelerometers> sound, Spoil spoil)
      : sound_(std::move(sound)), spoil_(std::move(spoil)) {}

  const std::vector<ChannelInfo>& channels() const override { return sound_->channels(); }
  double range_m_s2() const override { return sound_->range_m_s2(); }
  double rate_Hz() const override { return sound_->rate_Hz(); }
  double hole_told_after_s() const override { return sound_->hole_told_after_s(); }
  Status connect() override { return sound_->connect(); }
  Status start() override { return sound_->start(); }
  void stop() noexcept override { sound_->stop(); }
  Result<hal::AccelerationBlock> read() override {
    auto block = sound_->read();
    if (!block) return block;
    hal::AccelerationBlock spoilt = std::move(block).value();
    spoil_(spoilt.scans);
    return spoilt;
  }

 private:
  std::unique_ptr<hal::Accelerometers> sound_;
  Spoil spoil_;
};

/// A torque transducer that tells so many times what is there.
class SpoiltTorqueSensor final : public hal::TorqueSensor {
 public:
  SpoiltTorqueSensor(std::unique_ptr<hal::TorqueSensor> sound, double gain)
      : sound_(std::move(sound)), gain_(gain) {}

  double rate_Hz() const override { return sound_->rate_Hz(); }
  Status connect() override { return sound_->connect(); }
  Result<hal::TorqueBlock> read() override {
    auto block = sound_->read();
    if (!block) return block;
    hal::TorqueBlock spoilt = std::move(block).value();
    for (hal::TorqueSample& sample : spoilt.samples) sample.torque_Nm *= gain_;
    return spoilt;
  }

 private:
  std::unique_ptr<hal::TorqueSensor> sound_;
  double gain_;
};

/// A drive that turns so many times as fast as it is told.
class SpoiltDrive final : public hal::Drive {
 public:
  SpoiltDrive(std::unique_ptr<hal::Drive> sound, double gain)
      : sound_(std::move(sound)), gain_(gain) {}

  hal::DriveLimits limits() const override { return sound_->limits(); }
  Status connect() override { return sound_->connect(); }
  Result<hal::DriveWatchdog> read_watchdog() override { return sound_->read_watchdog(); }
  Status set_speed(double speed_rpm) override { return sound_->set_speed(gain_ * speed_rpm); }
  Result<hal::DriveStatus> read() override { return sound_->read(); }
  void stop() noexcept override { sound_->stop(); }
  int retries() const override { return sound_->retries(); }

 private:
  std::unique_ptr<hal::Drive> sound_;
  double gain_;
};

/// A brake that holds so many times what it is told.
class SpoiltBrake final : public hal::Brake {
 public:
  SpoiltBrake(std::unique_ptr<hal::Brake> sound, double gain)
      : sound_(std::move(sound)), gain_(gain) {}

  hal::BrakeLimits limits() const override { return sound_->limits(); }
  Status connect() override { return sound_->connect(); }
  Status set_torque(double torque_Nm) override { return sound_->set_torque(gain_ * torque_Nm); }
  Result<hal::BrakeStatus> read() override { return sound_->read(); }
  Status release() noexcept override { return sound_->release(); }

 private:
  std::unique_ptr<hal::Brake> sound_;
  double gain_;
};

}  // namespace rvbench::test
