#include <algorithm>
#include <memory>
#include <utility>

#include "tests/faults/guard.hpp"

namespace rvbench::test {
namespace {

/// A brake that is told everything, and tells or does what the guard leaves of it.
class BrakeWithout : public hal::Brake {
 public:
  explicit BrakeWithout(std::unique_ptr<hal::Brake> brake) : brake_(std::move(brake)) {}
  hal::BrakeLimits limits() const override { return brake_->limits(); }
  Status connect() override { return brake_->connect(); }
  Status set_torque(double torque_Nm) override { return brake_->set_torque(torque_Nm); }
  Result<hal::BrakeStatus> read() override {
    auto status = brake_->read();
    if (!status) return status;
    hal::BrakeStatus shown = status.value();
    show(shown);
    return shown;
  }
  Status release() noexcept override { return brake_->release(); }

 protected:
  virtual void show(hal::BrakeStatus&) {}

  std::unique_ptr<hal::Brake> brake_;
};

class NoRelease final : public BrakeWithout {
 public:
  using BrakeWithout::BrakeWithout;
  Status release() noexcept override { return Done{}; }
};

class NoBrakeFaults final : public BrakeWithout {
 public:
  using BrakeWithout::BrakeWithout;

 protected:
  void show(hal::BrakeStatus& status) override { status.tripped = false; }
};

// It does not tell what it holds: the input torque has nothing to agree with.
class NoMeasuredLoad final : public BrakeWithout {
 public:
  using BrakeWithout::BrakeWithout;

 protected:
  void show(hal::BrakeStatus& status) override {
    if (status.torque_Nm > 1) status.torque_Nm = not_known;
  }
};

// What was commanded once is not commanded again.
class NoCycle final : public BrakeWithout {
 public:
  using BrakeWithout::BrakeWithout;
  Status set_torque(double torque_Nm) override {
    if (torque_Nm == told_Nm_) return Done{};
    told_Nm_ = torque_Nm;
    return brake_->set_torque(torque_Nm);
  }

 private:
  double told_Nm_ = not_known;
};

/// Safety inputs of which the guard leaves less.
class SafetyWithout : public hal::SafetyInputs {
 public:
  explicit SafetyWithout(std::unique_ptr<hal::SafetyInputs> inputs) : inputs_(std::move(inputs)) {}
  Status connect() override { return inputs_->connect(); }
  Result<hal::SafetyStatus> read() override {
    auto status = inputs_->read();
    if (!status) return status;
    hal::SafetyStatus shown = status.value();
    show(shown);
    return shown;
  }

 protected:
  virtual void show(hal::SafetyStatus& status) = 0;

 private:
  std::unique_ptr<hal::SafetyInputs> inputs_;
};

class NoChain final : public SafetyWithout {
 public:
  using SafetyWithout::SafetyWithout;

 protected:
  void show(hal::SafetyStatus& status) override {
    status.estop_pressed = status.guard_open = false;
  }
};

class NoMissingTemperature final : public SafetyWithout {
 public:
  using SafetyWithout::SafetyWithout;

 protected:
  void show(hal::SafetyStatus& status) override {
    if (!(status.housing_temp_degC > 0)) status.housing_temp_degC = 25;
  }
};

/// Accelerometers whose blocks are shown as the guard leaves them.
class AccelerometersWithout : public hal::Accelerometers {
 public:
  AccelerometersWithout(std::unique_ptr<hal::Accelerometers> sensors, const hal::Clock& clock)
      : sensors_(std::move(sensors)), clock_(clock) {}
  const std::vector<ChannelInfo>& channels() const override { return sensors_->channels(); }
  double range_m_s2() const override { return sensors_->range_m_s2(); }
  double rate_Hz() const override { return sensors_->rate_Hz(); }
  Status connect() override { return sensors_->connect(); }
  Status start() override { return sensors_->start(); }
  Result<hal::AccelerationBlock> read() override {
    auto block = sensors_->read();
    if (!block) return block;
    hal::AccelerationBlock shown = std::move(block).value();
    show(shown, clock_.now_s());
    return shown;
  }
  void stop() noexcept override { sensors_->stop(); }

 protected:
  virtual void show(hal::AccelerationBlock& block, double now_s) = 0;

 private:
  std::unique_ptr<hal::Accelerometers> sensors_;
  const hal::Clock& clock_;
};

// Whatever its clock does, its samples end now.
class NoSampleClock final : public AccelerometersWithout {
 public:
  using AccelerometersWithout::AccelerometersWithout;

 protected:
  void show(hal::AccelerationBlock& block, double now_s) override {
    block.t0_s = std::min(block.t0_s, now_s - double(block.scans.rows()) / rate_Hz());
  }
};

class NoLostScans final : public AccelerometersWithout {
 public:
  using AccelerometersWithout::AccelerometersWithout;

 protected:
  void show(hal::AccelerationBlock& block, double) override { block.lost = 0; }
};

class NoLostTorque final : public hal::TorqueSensor {
 public:
  explicit NoLostTorque(std::unique_ptr<hal::TorqueSensor> sensor) : sensor_(std::move(sensor)) {}
  double rate_Hz() const override { return sensor_->rate_Hz(); }
  Status connect() override { return sensor_->connect(); }
  Result<hal::TorqueBlock> read() override {
    auto block = sensor_->read();
    if (!block) return block;
    hal::TorqueBlock shown = std::move(block).value();
    shown.lost = 0;
    return shown;
  }

 private:
  std::unique_ptr<hal::TorqueSensor> sensor_;
};

template <typename Shown>
Guard brake_by(std::string name) {
  return {std::move(name), [](Controller& controller) {
            controller.rig.brake = std::make_unique<Shown>(std::move(controller.rig.brake));
          }};
}

template <typename Shown>
Guard safety_by(std::string name) {
  return {std::move(name), [](Controller& controller) {
            controller.rig.safety = std::make_unique<Shown>(std::move(controller.rig.safety));
          }};
}

template <typename Shown>
Guard accelerations_by(std::string name) {
  return {std::move(name), [](Controller& controller) {
            hal::Rig& rig = controller.rig;
            rig.accelerometers = std::make_unique<Shown>(std::move(rig.accelerometers), *rig.clock);
          }};
}

}  // namespace

std::vector<Guard> guards_of_the_field() {
  return {
      brake_by<NoRelease>("release"),
      brake_by<NoBrakeFaults>("the brake's own faults"),
      brake_by<NoMeasuredLoad>("torque plausibility"),
      brake_by<NoCycle>("the brake's command cycle"),
      safety_by<NoChain>("emergency stop and guard"),
      safety_by<NoMissingTemperature>("temperature must be known"),
      accelerations_by<NoSampleClock>("sample clock"),
      accelerations_by<NoLostScans>("lost scans"),
      {"lost torque samples",
       [](Controller& controller) {
         controller.rig.torque_sensor =
             std::make_unique<NoLostTorque>(std::move(controller.rig.torque_sensor));
       }},
  };
}

}  // namespace rvbench::test
