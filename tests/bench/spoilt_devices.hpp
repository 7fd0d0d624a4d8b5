#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "tests/support/passing_devices.hpp"

namespace rvbench::test {

/// Accelerometers whose scans are spoilt on their way.
class SpoiltAccelerometers final : public PassingAccelerometers {
 public:
  using Spoil = std::function<void(hal::AccelerationBlock::Scans& scans)>;

  SpoiltAccelerometers(std::unique_ptr<hal::Accelerometers> sound, Spoil spoil)
      : PassingAccelerometers(std::move(sound)), spoil_(std::move(spoil)) {}

 protected:
  void show(hal::AccelerationBlock& block) override { spoil_(block.scans); }

 private:
  Spoil spoil_;
};

/// A torque transducer that tells so many times what is there.
class SpoiltTorqueSensor final : public PassingTorqueSensor {
 public:
  SpoiltTorqueSensor(std::unique_ptr<hal::TorqueSensor> sound, double gain)
      : PassingTorqueSensor(std::move(sound)), gain_(gain) {}

 protected:
  void show(hal::TorqueBlock& block) override {
    for (hal::TorqueSample& sample : block.samples) sample.torque_Nm *= gain_;
  }

 private:
  double gain_;
};

/// A drive that turns so many times as fast as it is told.
class SpoiltDrive final : public PassingDrive {
 public:
  SpoiltDrive(std::unique_ptr<hal::Drive> sound, double gain)
      : PassingDrive(std::move(sound)), gain_(gain) {}
  Status set_speed(double speed_rpm) override { return behind_->set_speed(gain_ * speed_rpm); }

 private:
  double gain_;
};

/// A brake that holds so many times what it is told.
class SpoiltBrake final : public PassingBrake {
 public:
  SpoiltBrake(std::unique_ptr<hal::Brake> sound, double gain)
      : PassingBrake(std::move(sound)), gain_(gain) {}
  Status set_torque(double torque_Nm) override { return behind_->set_torque(gain_ * torque_Nm); }

 private:
  double gain_;
};

}  // namespace rvbench::test
