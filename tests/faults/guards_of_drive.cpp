#include <cmath>
#include <memory>
#include <utility>

#include "tests/faults/guard.hpp"
#include "tests/support/passing_devices.hpp"

namespace rvbench::test {
namespace {

class NoStop final : public PassingDrive {
 public:
  using PassingDrive::PassingDrive;
  void stop() noexcept override {}
};

class NoDriveFaults final : public PassingDrive {
 public:
  using PassingDrive::PassingDrive;

 protected:
  void show(hal::DriveStatus& status) override {
    status.tripped = false;
    status.remote = true;
  }
};

// Whatever its settings are, they look safe.
class NoWatchdogCheck final : public PassingDrive {
 public:
  using PassingDrive::PassingDrive;
  Result<hal::DriveWatchdog> read_watchdog() override {
    const auto watchdog = behind_->read_watchdog();
    if (!watchdog) return watchdog;
    return hal::DriveWatchdog{.timeout_s = 0.5, .stops_motor = true};
  }
};

// It does not tell a speed that the angle could contradict.
class NoDriveSpeed final : public PassingDrive {
 public:
  using PassingDrive::PassingDrive;

 protected:
  void show(hal::DriveStatus& status) override { status.speed_rpm = not_known; }
};

// Once it was told to stop, the drive shows a shaft at rest.
class AtRestOnceStopped final : public PassingDrive {
 public:
  AtRestOnceStopped(std::unique_ptr<hal::Drive> drive, std::shared_ptr<bool> is_stopped)
      : PassingDrive(std::move(drive)), is_stopped_(std::move(is_stopped)) {}
  void stop() noexcept override {
    *is_stopped_ = true;
    behind_->stop();
  }

 protected:
  void show(hal::DriveStatus& status) override {
    if (!*is_stopped_) return;
    status.speed_rpm = 0;
    status.running = false;
  }

 private:
  std::shared_ptr<bool> is_stopped_;
};

// And so does the angle.
class AngleAtRestOnceStopped final : public PassingTorqueSensor {
 public:
  AngleAtRestOnceStopped(std::unique_ptr<hal::TorqueSensor> sensor,
                         std::shared_ptr<const bool> is_stopped)
      : PassingTorqueSensor(std::move(sensor)), is_stopped_(std::move(is_stopped)) {}

 protected:
  void show(hal::TorqueBlock& block) override {
    if (!*is_stopped_) return;
    for (hal::TorqueSample& sample : block.samples) {
      if (std::isnan(rest_rad_)) rest_rad_ = sample.angle_rad;
      sample.angle_rad = rest_rad_;
    }
  }

 private:
  std::shared_ptr<const bool> is_stopped_;
  double rest_rad_ = not_known;
};

// Somebody goes on asking the drive whenever the safety inputs are looked at, and so feeds its
// watchdog while the controller means to be silent.
class NoSilence final : public PassingSafetyInputs {
 public:
  NoSilence(std::unique_ptr<hal::SafetyInputs> inputs, hal::Drive& drive)
      : PassingSafetyInputs(std::move(inputs)), drive_(drive) {}
  Result<hal::SafetyStatus> read() override {
    (void)drive_.read();
    return behind_->read();
  }

 private:
  hal::Drive& drive_;
};

}  // namespace

std::vector<Guard> guards_of_the_drive() {
  return {
      shown_by<NoStop>("stop", &hal::Rig::drive),
      shown_by<NoDriveFaults>("the drive's own faults", &hal::Rig::drive),
      shown_by<NoWatchdogCheck>("watchdog check", &hal::Rig::drive),
      shown_by<NoDriveSpeed>("two speeds compared", &hal::Rig::drive),
      {"standstill awaited",
       [](Controller& controller) {
         auto is_stopped = std::make_shared<bool>(false);
         hal::Rig& rig = controller.rig;
         rig.drive = std::make_unique<AtRestOnceStopped>(std::move(rig.drive), is_stopped);
         rig.torque_sensor =
             std::make_unique<AngleAtRestOnceStopped>(std::move(rig.torque_sensor), is_stopped);
       }},
      {"silence",
       [](Controller& controller) {
         hal::Rig& rig = controller.rig;
         rig.safety = std::make_unique<NoSilence>(std::move(rig.safety), *rig.drive);
       }},
  };
}

}  // namespace rvbench::test
