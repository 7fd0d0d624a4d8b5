#include "hal/replay_rig.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "hal/recording_file.hpp"
#include "hal/replay_world.hpp"
#include "hal/steady_clock.hpp"
#include "hal/stepped_clock.hpp"

namespace rvbench::hal {
namespace {

IoError not_connected(const char* where) { return {IoErrc::disconnected, where}; }

class ReplayDrive final : public Drive {
 public:
  explicit ReplayDrive(ReplayWorld& world) : world_(world) {}

  DriveLimits limits() const override { return {std::max(3000.0, world_.fastest_rpm())}; }

  Status connect() override {
    connected_ = true;
    world_.command_speed(0);
    return Done{};
  }

  Result<DriveWatchdog> read_watchdog() override {
    if (!connected_) return not_connected("replayed drive: read watchdog");
    return DriveWatchdog{1.0, true};
  }

  Status set_speed(double speed_rpm) override {
    if (!(std::abs(speed_rpm) <= limits().max_speed_rpm)) {
      throw std::invalid_argument("ReplayDrive::set_speed: " + std::to_string(speed_rpm) +
                                  " rpm is beyond " + std::to_string(limits().max_speed_rpm));
    }
    if (!connected_) return not_connected("replayed drive: set speed");
    world_.command_speed(speed_rpm);
    return Done{};
  }

  Result<DriveStatus> read() override {
    if (!connected_) return not_connected("replayed drive: read");
    DriveStatus status;
    status.speed_rpm = world_.measured_speed_rpm();
    status.running = status.speed_rpm != 0;
    return status;
  }

  void stop() noexcept override { world_.command_speed(0); }
  int retries() const override { return 0; }

 private:
  ReplayWorld& world_;
  bool connected_ = false;
};

class ReplayBrake final : public Brake {
 public:
  explicit ReplayBrake(ReplayWorld& world) : world_(world) {}

  BrakeLimits limits() const override { return {3 * world_.options().rated_output_torque_Nm}; }

  Status connect() override {
    connected_ = true;
    world_.command_brake(0);
    return Done{};
  }

  Status set_torque(double torque_Nm) override {
    if (!(torque_Nm >= 0 && torque_Nm <= limits().max_torque_Nm)) {
      throw std::invalid_argument("ReplayBrake::set_torque: " + std::to_string(torque_Nm) +
                                  " N·m is not within 0 and " +
                                  std::to_string(limits().max_torque_Nm));
    }
    if (!connected_) return not_connected("replayed brake: set torque");
    world_.command_brake(torque_Nm);
    return Done{};
  }

  Result<BrakeStatus> read() override {
    if (!connected_) return not_connected("replayed brake: read");
    return BrakeStatus{world_.brake_torque_Nm(), false};
  }

  Status release() noexcept override {
    world_.command_brake(0);
    return Done{};
  }

 private:
  ReplayWorld& world_;
  bool connected_ = false;
};

class ReplayTorqueSensor final : public TorqueSensor {
 public:
  explicit ReplayTorqueSensor(ReplayWorld& world) : world_(world) {}

  double rate_Hz() const override { return world_.layout().torque_rate_Hz; }

  Status connect() override {
    const Result<TorqueBlock> missed = world_.take_torque();
    if (!missed) return missed.error();
    connected_ = true;
    return Done{};
  }

  Result<TorqueBlock> read() override {
    if (!connected_) return not_connected("replayed torque sensor: read");
    return world_.take_torque();
  }

 private:
  ReplayWorld& world_;
  bool connected_ = false;
};

class ReplayAccelerometers final : public Accelerometers {
 public:
  explicit ReplayAccelerometers(ReplayWorld& world) : world_(world) {}

  const std::vector<ChannelInfo>& channels() const override {
    return world_.layout().acceleration_channels;
  }
  double range_m_s2() const override { return world_.layout().acceleration_range_m_s2; }
  double rate_Hz() const override { return world_.layout().acceleration_rate_Hz; }

  Status connect() override {
    connected_ = true;
    return Done{};
  }

  Status start() override {
    if (!connected_) return not_connected("replayed accelerometers: start");
    const Result<AccelerationBlock> missed = world_.take_accelerations();
    if (!missed) return missed.error();
    started_ = true;
    return Done{};
  }

  Result<AccelerationBlock> read() override {
    if (!started_) return not_connected("replayed accelerometers: read");
    return world_.take_accelerations();
  }

  void stop() noexcept override { started_ = false; }

 private:
  ReplayWorld& world_;
  bool connected_ = false;
  bool started_ = false;
};

// A recording says nothing of the safety chain: it was closed, or nothing had been recorded.
class ReplaySafetyInputs final : public SafetyInputs {
 public:
  Status connect() override {
    connected_ = true;
    return Done{};
  }

  Result<SafetyStatus> read() override {
    if (!connected_) return not_connected("replayed safety inputs: read");
    return SafetyStatus{.estop_pressed = false, .guard_open = false};
  }

 private:
  bool connected_ = false;
};

// Why the recording cannot stand for a bench; empty if it can.
std::string find_lack(RecordingReader& reader) {
  const RecordingLayout& layout = reader.layout();
  if (layout.acceleration_channels.empty() || !(layout.acceleration_rate_Hz > 0)) {
    return "no accelerations at a known rate";
  }
  if (!(layout.torque_rate_Hz > 0)) return "no torque at a known rate";
  bool any = false;
  for (const PointResult& result : reader.results()) {
    if (result.status == "unsettled") continue;
    any = true;
    if (result.point < 0 || static_cast<std::size_t>(result.point) >= layout.points.size()) {
      return "/points/index: no such point: " + std::to_string(result.point);
    }
    const Result<Recording> point = reader.read(result.point);
    if (!point) return describe(point.error());
    for (const ChannelInfo& channel : layout.acceleration_channels) {
      const Channel* found = point.value().find(channel.name);
      if (found == nullptr || found->samples.size() == 0) return "no samples of " + channel.name;
    }
    const Channel* torque = point.value().find(channel_names::input_torque);
    const Channel* angle = point.value().find(channel_names::input_angle);
    if (torque == nullptr || angle == nullptr || angle->samples.size() == 0 ||
        angle->samples.size() != torque->samples.size()) {
      return "torque and angle are not as long as each other";
    }
  }
  return any ? "" : "no point that settled and ended";
}

}  // namespace

Result<Rig> make_replay_rig(const std::filesystem::path& file, const ReplayOptions& options) {
  if (!(options.rated_output_torque_Nm > 0) || !(options.lead_in_s >= 0)) {
    throw std::invalid_argument("make_replay_rig: rated torque must be above 0, lead-in not below");
  }
  auto opened = RecordingReader::open(file);
  if (!opened) return opened.error();
  std::unique_ptr<RecordingReader> reader = std::move(opened).value();
  if (const std::string lack = find_lack(*reader); !lack.empty()) {
    return IoError{IoErrc::refused, file.string() + ": cannot be replayed: " + lack};
  }
  std::unique_ptr<Clock> clock = std::make_unique<SteppedClock>();
  if (options.real_time) clock = std::make_unique<SteadyClock>();
  auto backstage = std::make_unique<ReplayWorld>(std::move(reader), options, *clock);
  ReplayWorld& world = *backstage;
  Rig rig;
  rig.name = "replay of " + file.filename().string();
  rig.is_played = true;
  rig.backstage = std::move(backstage);
  rig.clock = std::move(clock);
  rig.safety = std::make_unique<ReplaySafetyInputs>();
  rig.accelerometers = std::make_unique<ReplayAccelerometers>(world);
  rig.torque_sensor = std::make_unique<ReplayTorqueSensor>(world);
  rig.brake = std::make_unique<ReplayBrake>(world);
  rig.drive = std::make_unique<ReplayDrive>(world);
  return rig;
}

}  // namespace rvbench::hal
