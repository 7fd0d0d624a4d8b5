#include <algorithm>
#include <memory>
#include <utility>

#include "tests/faults/guard.hpp"
#include "tests/support/passing_devices.hpp"

namespace rvbench::test {
namespace {

class NoRelease final : public PassingBrake {
 public:
  using PassingBrake::PassingBrake;
  Status release() noexcept override { return Done{}; }
};

class NoBrakeFaults final : public PassingBrake {
 public:
  using PassingBrake::PassingBrake;

 protected:
  void show(hal::BrakeStatus& status) override { status.tripped = false; }
};

// It does not tell what it holds: the input torque has nothing to agree with.
class NoMeasuredLoad final : public PassingBrake {
 public:
  using PassingBrake::PassingBrake;

 protected:
  void show(hal::BrakeStatus& status) override {
    if (status.torque_Nm > 1) status.torque_Nm = not_known;
  }
};

// What was commanded once is not commanded again.
class NoCycle final : public PassingBrake {
 public:
  using PassingBrake::PassingBrake;
  Status set_torque(double torque_Nm) override {
    if (torque_Nm == told_Nm_) return Done{};
    told_Nm_ = torque_Nm;
    return behind_->set_torque(torque_Nm);
  }

 private:
  double told_Nm_ = not_known;
};

class NoChain final : public PassingSafetyInputs {
 public:
  using PassingSafetyInputs::PassingSafetyInputs;

 protected:
  void show(hal::SafetyStatus& status) override {
    status.estop_pressed = status.guard_open = false;
  }
};

class NoMissingTemperature final : public PassingSafetyInputs {
 public:
  using PassingSafetyInputs::PassingSafetyInputs;

 protected:
  void show(hal::SafetyStatus& status) override {
    if (!(status.housing_temp_degC > 0)) status.housing_temp_degC = 25;
  }
};

// Whatever its clock does, its samples end now.
class NoSampleClock final : public PassingAccelerometers {
 public:
  NoSampleClock(std::unique_ptr<hal::Accelerometers> sensors, const hal::Clock& clock)
      : PassingAccelerometers(std::move(sensors)), clock_(clock) {}

 protected:
  void show(hal::AccelerationBlock& block) override {
    block.t0_s = std::min(block.t0_s, clock_.now_s() - double(block.scans.rows()) / rate_Hz());
  }

 private:
  const hal::Clock& clock_;
};

class NoLostScans final : public PassingAccelerometers {
 public:
  using PassingAccelerometers::PassingAccelerometers;

 protected:
  void show(hal::AccelerationBlock& block) override { block.lost = 0; }
};

class NoLostTorque final : public PassingTorqueSensor {
 public:
  using PassingTorqueSensor::PassingTorqueSensor;

 protected:
  void show(hal::TorqueBlock& block) override { block.lost = 0; }
};

}  // namespace

std::vector<Guard> guards_of_the_field() {
  return {
      shown_by<NoRelease>("release", &hal::Rig::brake),
      shown_by<NoBrakeFaults>("the brake's own faults", &hal::Rig::brake),
      shown_by<NoMeasuredLoad>("torque plausibility", &hal::Rig::brake),
      shown_by<NoCycle>("the brake's command cycle", &hal::Rig::brake),
      shown_by<NoChain>("emergency stop and guard", &hal::Rig::safety),
      shown_by<NoMissingTemperature>("temperature must be known", &hal::Rig::safety),
      {"sample clock",
       [](Controller& controller) {
         hal::Rig& rig = controller.rig;
         rig.accelerometers =
             std::make_unique<NoSampleClock>(std::move(rig.accelerometers), *rig.clock);
       }},
      shown_by<NoLostScans>("lost scans", &hal::Rig::accelerometers),
      shown_by<NoLostTorque>("lost torque samples", &hal::Rig::torque_sensor),
  };
}

}  // namespace rvbench::test
