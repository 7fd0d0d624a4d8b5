#include <cmath>
#include <memory>
#include <utility>

#include "tests/faults/guard.hpp"

namespace rvbench::test {
namespace {

/// A drive that is told everything, and tells or does what the guard leaves of it.
class DriveWithout : public hal::Drive {
 public:
  explicit DriveWithout(std::unique_ptr<hal::Drive> drive) : drive_(std::move(drive)) {}
  hal::DriveLimits limits() const override { return drive_->limits(); }
  Status connect() override { return drive_->connect(); }
  Result<hal::DriveWatchdog> read_watchdog() override { return drive_->read_watchdog(); }
  Status set_speed(double speed_rpm) override { return drive_->set_speed(speed_rpm); }
  Result<hal::DriveStatus> read() override {
    auto status = drive_->read();
    if (!status) return status;
    hal::DriveStatus shown = status.value();
    show(shown);
    return shown;
  }
  void stop() noexcept override { drive_->stop(); }
  int retries() const override { return drive_->retries(); }

 protected:
  virtual void show(hal::DriveStatus&) {}

  std::unique_ptr<hal::Drive> drive_;
};

class NoStop final : public DriveWithout {
 public:
  using DriveWithout::DriveWithout;
  void stop() noexcept override {}
};

class NoDriveFaults final : public DriveWithout {
 public:
  using DriveWithout::DriveWithout;

 protected:
  void show(hal::DriveStatus& status) override {
    status.tripped = false;
    status.remote = true;
  }
};

// Whatever its settings are, they look safe.
class NoWatchdogCheck final : public DriveWithout {
 public:
  using DriveWithout::DriveWithout;
  Result<hal::DriveWatchdog> read_watchdog() override {
    const auto watchdog = drive_->read_watchdog();
    if (!watchdog) return watchdog;
    return hal::DriveWatchdog{.timeout_s = 0.5, .stops_motor = true};
  }
};

// It does not tell a speed that the angle could contradict.
class NoDriveSpeed final : public DriveWithout {
 public:
  using DriveWithout::DriveWithout;

 protected:
  void show(hal::DriveStatus& status) override { status.speed_rpm = not_known; }
};

// Once it was told to stop, the drive shows a shaft at rest.
class AtRestOnceStopped final : public DriveWithout {
 public:
  AtRestOnceStopped(std::unique_ptr<hal::Drive> drive, std::shared_ptr<bool> is_stopped)
      : DriveWithout(std::move(drive)), is_stopped_(std::move(is_stopped)) {}
  void stop() noexcept override {
    *is_stopped_ = true;
    drive_->stop();
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
class AngleAtRestOnceStopped final : public hal::TorqueSensor {
 public:
  AngleAtRestOnceStopped(std::unique_ptr<hal::TorqueSensor> sensor,
                         std::shared_ptr<const bool> is_stopped)
      : sensor_(std::move(sensor)), is_stopped_(std::move(is_stopped)) {}
  double rate_Hz() const override { return sensor_->rate_Hz(); }
  Status connect() override { return sensor_->connect(); }
  Result<hal::TorqueBlock> read() override {
    auto block = sensor_->read();
    if (!block || !*is_stopped_) return block;
    hal::TorqueBlock shown = std::move(block).value();
    for (hal::TorqueSample& sample : shown.samples) {
      if (std::isnan(rest_rad_)) rest_rad_ = sample.angle_rad;
      sample.angle_rad = rest_rad_;
    }
    return shown;
  }

 private:
  std::unique_ptr<hal::TorqueSensor> sensor_;
  std::shared_ptr<const bool> is_stopped_;
  double rest_rad_ = not_known;
};

// Somebody goes on asking the drive whenever the safety inputs are looked at, and so feeds its
// watchdog while the controller means to be silent.
class NoSilence final : public hal::SafetyInputs {
 public:
  NoSilence(std::unique_ptr<hal::SafetyInputs> inputs, hal::Drive& drive)
      : inputs_(std::move(inputs)), drive_(drive) {}
  Status connect() override { return inputs_->connect(); }
  Result<hal::SafetyStatus> read() override {
    (void)drive_.read();
    return inputs_->read();
  }

 private:
  std::unique_ptr<hal::SafetyInputs> inputs_;
  hal::Drive& drive_;
};

template <typename Shown>
Guard shown_by(std::string name) {
  return {std::move(name), [](Controller& controller) {
            controller.rig.drive = std::make_unique<Shown>(std::move(controller.rig.drive));
          }};
}

}  // namespace

std::vector<Guard> guards_of_the_drive() {
  return {
      shown_by<NoStop>("stop"),
      shown_by<NoDriveFaults>("the drive's own faults"),
      shown_by<NoWatchdogCheck>("watchdog check"),
      shown_by<NoDriveSpeed>("two speeds compared"),
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
