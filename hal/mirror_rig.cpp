#include "hal/mirror_rig.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "hal/mirror_accelerometers.hpp"
#include "hal/stepped_clock.hpp"

namespace rvbench::hal {
namespace {

// A call to a device that may be dead: it takes the whole deadline to find out.
std::optional<IoError> no_answer(MirrorWorld& world, bool connected, MirrorFault dead,
                                 const char* where) {
  if (!connected) return IoError{IoErrc::disconnected, where};
  if (!world.has(dead)) return std::nullopt;
  world.clock().wait_until(world.clock().now_s() + world.options().deadline_s);
  return IoError{IoErrc::timeout, where};
}

class MirrorDrive final : public Drive {
 public:
  explicit MirrorDrive(MirrorWorld& world) : world_(world) {}

  DriveLimits limits() const override { return {world_.options().max_speed_rpm}; }

  Status connect() override {
    if (auto error = no_answer(world_, true, MirrorFault::drive_dead, "mirror drive: connect")) {
      return *error;
    }
    connected_ = true;
    world_.command_speed(0);
    return Done{};
  }

  Result<DriveWatchdog> read_watchdog() override {
    if (auto error =
            no_answer(world_, connected_, MirrorFault::drive_dead, "mirror drive: read watchdog")) {
      return *error;
    }
    return world_.options().watchdog;
  }

  Status set_speed(double speed_rpm) override {
    if (!(std::abs(speed_rpm) <= limits().max_speed_rpm)) {
      throw std::invalid_argument("MirrorDrive::set_speed: " + std::to_string(speed_rpm) +
                                  " rpm is beyond " + std::to_string(limits().max_speed_rpm));
    }
    if (auto error =
            no_answer(world_, connected_, MirrorFault::drive_dead, "mirror drive: set speed")) {
      return *error;
    }
    world_.command_speed(speed_rpm);
    return Done{};
  }

  Result<DriveStatus> read() override {
    if (auto error = no_answer(world_, connected_, MirrorFault::drive_dead, "mirror drive: read")) {
      return *error;
    }
    if (world_.has(MirrorFault::drive_throws)) throw std::runtime_error("a defect of the driver");
    if (world_.has(MirrorFault::drive_frozen)) return last_;
    world_.advance();
    last_.speed_rpm = world_.speed_rpm();
    last_.output_frequency_Hz = world_.speed_rpm() / 30;  // two pole pairs
    last_.running = world_.speed_rpm() != 0;
    last_.tripped = world_.has(MirrorFault::drive_tripped);
    last_.fault_code = last_.tripped ? 7 : 0;
    return last_;
  }

  void stop() noexcept override {
    if (!no_answer(world_, connected_, MirrorFault::drive_dead, "mirror drive: stop")) {
      world_.command_speed(0);
    }
  }

  int retries() const override { return 0; }

 private:
  MirrorWorld& world_;
  bool connected_ = false;
  DriveStatus last_;
};

class MirrorBrake final : public Brake {
 public:
  explicit MirrorBrake(MirrorWorld& world) : world_(world) {}

  BrakeLimits limits() const override { return {world_.options().max_brake_torque_Nm}; }

  Status connect() override {
    if (auto error = no_answer(world_, true, MirrorFault::brake_dead, "mirror brake: connect")) {
      return *error;
    }
    connected_ = true;
    world_.release_brake();
    return Done{};
  }

  Status set_torque(double torque_Nm) override {
    if (!(torque_Nm >= 0 && torque_Nm <= limits().max_torque_Nm)) {
      throw std::invalid_argument("MirrorBrake::set_torque: " + std::to_string(torque_Nm) +
                                  " N·m is not within 0 and " +
                                  std::to_string(limits().max_torque_Nm));
    }
    if (auto error =
            no_answer(world_, connected_, MirrorFault::brake_dead, "mirror brake: set torque")) {
      return *error;
    }
    world_.command_brake(torque_Nm);
    return Done{};
  }

  Result<BrakeStatus> read() override {
    if (auto error = no_answer(world_, connected_, MirrorFault::brake_dead, "mirror brake: read")) {
      return *error;
    }
    world_.advance();
    return BrakeStatus{world_.brake_torque_Nm(), world_.has(MirrorFault::brake_tripped)};
  }

  Status release() noexcept override {
    if (auto error =
            no_answer(world_, connected_, MirrorFault::brake_dead, "mirror brake: release")) {
      return *error;
    }
    world_.release_brake();
    return Done{};
  }

 private:
  MirrorWorld& world_;
  bool connected_ = false;
};

class MirrorTorqueSensor final : public TorqueSensor {
 public:
  explicit MirrorTorqueSensor(MirrorWorld& world) : world_(world) {}

  double rate_Hz() const override { return world_.options().torque_rate_Hz; }

  Status connect() override {
    constexpr const char* where = "mirror torque sensor: connect";
    if (auto error = no_answer(world_, true, MirrorFault::torque_sensor_dead, where)) return *error;
    connected_ = true;
    sent_ += world_.take_samples().size();
    return Done{};
  }

  Result<TorqueBlock> read() override {
    constexpr const char* where = "mirror torque sensor: read";
    if (auto error = no_answer(world_, connected_, MirrorFault::torque_sensor_dead, where)) {
      return *error;
    }
    if (world_.has(MirrorFault::torque_sensor_frozen)) return last_;
    last_ = {double(sent_ + 1) / rate_Hz(), world_.take_samples(), 0};
    sent_ += last_.samples.size();
    return last_;
  }

 private:
  MirrorWorld& world_;
  bool connected_ = false;
  std::size_t sent_ = 0;
  TorqueBlock last_;
};

class MirrorSafetyInputs final : public SafetyInputs {
 public:
  explicit MirrorSafetyInputs(MirrorWorld& world) : world_(world) {}

  Status connect() override {
    constexpr const char* where = "mirror safety inputs: connect";
    if (auto error = no_answer(world_, true, MirrorFault::safety_dead, where)) return *error;
    connected_ = true;
    return Done{};
  }

  Result<SafetyStatus> read() override {
    constexpr const char* where = "mirror safety inputs: read";
    if (auto error = no_answer(world_, connected_, MirrorFault::safety_dead, where)) return *error;
    return SafetyStatus{world_.has(MirrorFault::estop), world_.has(MirrorFault::guard_open),
                        world_.has(MirrorFault::over_temperature) ? 100.0 : 25.0};
  }

 private:
  MirrorWorld& world_;
  bool connected_ = false;
};

}  // namespace

Rig make_mirror_rig(const MirrorOptions& options) {
  auto clock = std::make_unique<SteppedClock>();
  auto backstage = std::make_unique<MirrorWorld>(options, *clock);
  MirrorWorld& world = *backstage;
  Rig rig;
  rig.name = "mirror";
  rig.backstage = std::move(backstage);
  rig.clock = std::move(clock);
  rig.safety = std::make_unique<MirrorSafetyInputs>(world);
  rig.accelerometers = std::make_unique<MirrorAccelerometers>(world);
  rig.torque_sensor = std::make_unique<MirrorTorqueSensor>(world);
  rig.brake = std::make_unique<MirrorBrake>(world);
  rig.drive = std::make_unique<MirrorDrive>(world);
  return rig;
}

MirrorWorld& mirror_world(Rig& rig) { return dynamic_cast<MirrorWorld&>(*rig.backstage); }

}  // namespace rvbench::hal
