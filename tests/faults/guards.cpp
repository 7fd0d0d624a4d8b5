#include "tests/faults/fault_run.hpp"

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
  Result<hal::DriveStatus> read() override { return drive_->read(); }
  void stop() noexcept override { drive_->stop(); }
  int retries() const override { return drive_->retries(); }

 protected:
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
  Result<hal::DriveStatus> read() override {
    auto status = drive_->read();
    if (!status) return status;
    hal::DriveStatus shown = status.value();
    shown.tripped = false;
    shown.remote = true;
    return shown;
  }
};

class NoRelease final : public hal::Brake {
 public:
  explicit NoRelease(std::unique_ptr<hal::Brake> brake) : brake_(std::move(brake)) {}
  hal::BrakeLimits limits() const override { return brake_->limits(); }
  Status connect() override { return brake_->connect(); }
  Status set_torque(double torque_Nm) override { return brake_->set_torque(torque_Nm); }
  Result<hal::BrakeStatus> read() override { return brake_->read(); }
  void release() noexcept override {}

 private:
  std::unique_ptr<hal::Brake> brake_;
};

class NoChain final : public hal::SafetyInputs {
 public:
  explicit NoChain(std::unique_ptr<hal::SafetyInputs> inputs) : inputs_(std::move(inputs)) {}
  Status connect() override { return inputs_->connect(); }
  Result<hal::SafetyStatus> read() override {
    auto status = inputs_->read();
    if (!status) return status;
    return hal::SafetyStatus{false, false, status.value().housing_temp_degC};
  }

 private:
  std::unique_ptr<hal::SafetyInputs> inputs_;
};

}  // namespace

const std::vector<Guard>& guards() {
  static const std::vector<Guard> all{
      {"limits",
       [](sequences::TestPlan& plan, hal::Rig&) {
         plan.interlocks.acceleration_m_s2 = 0.99 * FaultBench::range_m_s2;
         plan.interlocks.input_torque_Nm = 1e6;
         plan.interlocks.housing_temp_degC = 1e6;
       }},
      {"staleness",
       [](sequences::TestPlan& plan, hal::Rig&) { plan.interlocks.stale_after_s = 1e3; }},
      {"emergency stop and guard",
       [](sequences::TestPlan&, hal::Rig& rig) {
         rig.safety = std::make_unique<NoChain>(std::move(rig.safety));
       }},
      {"stop", [](sequences::TestPlan&,
                  hal::Rig& rig) { rig.drive = std::make_unique<NoStop>(std::move(rig.drive)); }},
      {"the drive's own faults",
       [](sequences::TestPlan&, hal::Rig& rig) {
         rig.drive = std::make_unique<NoDriveFaults>(std::move(rig.drive));
       }},
      {"release",
       [](sequences::TestPlan&, hal::Rig& rig) {
         rig.brake = std::make_unique<NoRelease>(std::move(rig.brake));
       }},
  };
  return all;
}

}  // namespace rvbench::test
